"""A run that takes more time or memory than it should pauses, says so, and goes on if asked to."""

import pytest

from sandbox.app import limits
from sandbox.app.session import Session
from sandbox.app.window import Window
from sandbox.physics.measuring import recording
from tests.app import scenes

FRAME = 1 / 60  # s


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every step be one that takes too long."""
    monkeypatch.setattr(limits, "SLOW", 0.0)


def played(*, patient: bool = False) -> Session:
    """Return a session that has played for as many frames as its level would last."""
    session = Session(scenes.level(), patient=patient)
    session.toggle()
    for _ in range(100):
        session.update(FRAME)
    return session


@pytest.mark.usefixtures("slow")
def test_a_run_whose_steps_take_long_pauses_after_two_and_says_so() -> None:
    session = played()

    assert session.world.steps == 2  # the first may have been held up by the machine
    assert not session.playing
    assert session.failure is None
    assert session.halted.startswith("A step takes 0.0")


@pytest.mark.usefixtures("slow")
def test_who_plays_it_all_the_same_is_not_asked_again() -> None:
    session = played()

    session.toggle()
    for _ in range(100):
        session.update(FRAME)

    assert session.at_end
    assert not session.halted


@pytest.mark.usefixtures("slow")
def test_a_way_ahead_ends_where_steps_take_long_and_can_be_taken_up_again() -> None:
    session = Session(scenes.level(), patient=False)

    session.go_to(40)
    assert (session.world.steps, session.sought) == (2, None)
    session.go_to(40)
    for _ in range(40):
        session.update(FRAME)
    assert (session.world.steps, session.sought) == (40, None)


@pytest.mark.usefixtures("slow")
def test_where_nobody_looks_no_run_pauses() -> None:
    assert played(patient=True).at_end


@pytest.mark.usefixtures("slow")
def test_the_window_says_why_it_has_paused_and_another_level_can_be_opened() -> None:
    window = Window((900, 600))
    window.open_level("kinematics/free-fall")
    window.do("play")
    for _ in range(4):
        window.frame(FRAME)

    assert window.session is not None
    assert window.session.world.steps == 2
    assert window.session.halted
    window.open_level("newton/atwood")
    assert not window.session.halted
    window.close()


def test_a_recording_ends_where_memory_should_hold_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "LARGEST", 8 * 3 * 20)
    session = played()

    count = len(session.trace.t)
    assert session.halted.startswith(f"{count} instants are recorded")
    assert session.world.steps == count - 1 < session.end
    session.toggle()
    for _ in range(100):
        session.update(FRAME)

    assert session.at_end
    assert len(session.trace.t) == count
