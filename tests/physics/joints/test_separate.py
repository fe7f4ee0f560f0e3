"""Joints that meet no other are solved by themselves, to the same motion."""

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, disc, level

BEADS: dict[str, Spec] = {
    "bead": disc((0, 0), mass=2, velocity=[3, 1.8]),
    "other": disc((5, 1), mass=0.5),
}
WIRES: dict[str, Spec] = {
    "wave": {"type": "wire", "bead": "bead", "curve": ["s", "0.3*sin(2*s)"], "s": [-9, 9]},
    "bowl": {"type": "wire", "bead": "other", "curve": ["4 + s", "s**2"], "s": [-2, 2]},
}
MEET: dict[str, Spec] = {
    "one": {"type": "rod", "ends": [[19, 0], "upper"]},
    "two": {"type": "rod", "ends": ["upper", "lower"]},
}


def beads(scheme: str, *, meet: bool) -> Level:
    """Two beads on wires, alone or beside two rods that meet."""
    bodies = dict(BEADS)
    if meet:
        bodies |= {"upper": disc((20, 0)), "lower": disc((21, 0))}
    joints = {**WIRES, **(MEET if meet else {})}
    return level(bodies, GRAVITY, joints=joints, stepping={"rate": 240, "scheme": scheme})


@pytest.mark.sweep
@pytest.mark.parametrize("scheme", ["leapfrog", "fourth-order"])
def test_beads_that_meet_nothing_move_as_beside_rods_that_meet(scheme: str) -> None:
    """They are solved in floats, and beside two rods that meet all in arrays: to rounding."""
    alone, together = (build(beads(scheme, meet=meet)) for meet in (False, True))

    one, two = alone.advance(480), together.advance(480)

    assert np.abs(one.position - two.position[:2]).max() <= 1e-11  # 1e-14
    assert np.abs(one.velocity - two.velocity[:2]).max() <= 1e-10
    assert one.tension == pytest.approx(two.tension[:2], rel=1e-8)
