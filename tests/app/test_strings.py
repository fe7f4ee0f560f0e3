"""The wheels of strings: inside a wide bend, and on the peg in a sharp one."""

from math import dist, pi

import pytest

from sandbox.app.stage.strings import WHEEL, _bend


@pytest.mark.parametrize("apart", [0.0, 1.0, 30.0, -30.0])
def test_a_block_hangs_in_the_loop_of_its_string(apart: float) -> None:
    """The wheel was above the block, the farther the nearer the strands were to each other."""
    peg = (0.0, 0.0)
    bend = _bend((-apart / 2, -200.0), peg, (apart / 2, -200.0))
    assert bend is not None
    assert bend.center == peg
    assert [dist(place, peg) for place in bend.arc] == pytest.approx([WHEEL] * len(bend.arc))
    lowest = max(y for _, y in bend.arc)  # on the stage, y points down
    assert lowest == pytest.approx(WHEEL, rel=1e-2)
    length = sum(map(dist, bend.arc, bend.arc[1:]))
    assert length == pytest.approx(pi * WHEEL, rel=0.1)  # about half a turn


def test_over_a_wide_bend_the_wheel_is_inside() -> None:
    bend = _bend((-200.0, 0.0), (0.0, 0.0), (0.0, 200.0))
    assert bend is not None
    assert bend.center == pytest.approx((-WHEEL, WHEEL))
