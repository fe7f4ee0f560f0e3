"""Gaps between sides are those of the corners that lie on them, however far the bodies move."""

import numpy as np
import pytest

from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, box, fixed, level

STAIR: dict[str, Spec] = {
    "ground": fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5)),
    "lower": box((0, 0.1), size=(0.4, 0.2)),
    "upper": box((0.1, 0.3), size=(0.4, 0.2)),
}
"""The lower right corner of the upper box sticks out, and the upper left one of the lower box."""


@pytest.mark.parametrize("names", [("lower", "upper"), ("upper", "lower")])
def test_each_point_of_two_sides_has_its_own_side(names: tuple[str, str]) -> None:
    """One gap was that of a point that slides away: 6 mm off as the upper box slides and turns."""
    bodies = {name: STAIR[name] for name in ("ground", *names)}
    contact: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "rotation": {}}
    world = build(level(bodies, contact))
    world.advance()
    direct = world.scene.direct
    assert direct
    assert direct._taken
    kick = direct._taken.kick
    upper, count = list(bodies).index("upper"), len(kick.place.values) // 3 - 1
    slide, turn = 0.05, 0.1
    way = np.zeros(3 * (count + 1))
    way[2 * upper], way[2 * (count + 1) + upper] = slide, turn

    opened = (kick.rows(way).total - kick.here.total)[kick.layout.gaps]

    there = Coordinates(kick.place.values + way)
    center, turned = complex(there.plane[upper]), complex(there.turned[upper])
    tip = (center + (-0.2 - 0.1j) * turned).imag - 0.2  # its corner above the lower box
    below = -((0.2 + 0.2j - center) * turned.conjugate()).imag - 0.1  # that of the lower one
    on_lower = (kick.layout.touching.bodies > 0).all(axis=0)
    assert sorted(opened[on_lower]) == pytest.approx(sorted((tip, below)), abs=1e-7)  # m, the skin
