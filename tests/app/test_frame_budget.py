"""A frame gives to steps the time that it does not need itself."""

import pytest

from sandbox.app.frame_budget import FRAME, LEAST, MEMORY, MOST, SPARE, FrameBudget


def test_steps_have_what_frames_of_the_same_kind_have_left() -> None:
    allowance = FrameBudget()
    for _ in range(MEMORY):
        allowance.note("", 0.005)
        allowance.note("page", 0.008)

    assert allowance.of("") == pytest.approx(FRAME - SPARE - 0.005)
    assert allowance.of("page") == pytest.approx(FRAME - SPARE - 0.008)


def test_a_frame_that_was_held_up_takes_nothing_from_the_steps_of_others() -> None:
    allowance = FrameBudget()
    for _ in range(MEMORY - 1):
        allowance.note("", 0.005)
    before = allowance.of("")

    allowance.note("", 1.0)

    assert allowance.of("") == before


def test_steps_always_have_something_and_never_all() -> None:
    allowance = FrameBudget()
    assert LEAST < allowance.of("") < MOST
    for seconds, expected in ((0.1, 2 * FRAME), (0.0, MOST)):
        for _ in range(MEMORY):
            allowance.note("", seconds)
        assert allowance.of("") == expected


@pytest.mark.parametrize(
    ("rest", "expected"),
    [
        (FRAME - SPARE - LEAST, LEAST),  # 60 frames a second can be held, and are
        (0.012, 0.012),  # they cannot: then as much as the rest,
        (0.02, 2 * FRAME - SPARE - 0.02),  # as long as there are 30,
        (0.04, 0.02),  # and beyond, a third of the time
    ],
)
def test_where_drawing_is_too_slow_for_60_frames_steps_have_more_of_the_time(
    rest: float, expected: float
) -> None:
    """They had 5 ms, however long the frame took: the run was slow while the picture was not."""
    allowance = FrameBudget()
    for _ in range(MEMORY):
        allowance.note("", rest)

    assert allowance.of("") == pytest.approx(expected)
