"""Gaps between sides are those of the corners that lie on them, however far the bodies move."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, floor, level

STAIR: dict[str, Spec] = {
    "ground": fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5)),
    "lower": box((0, 0.1), size=(0.4, 0.2)),
    "upper": box((0.1, 0.3), size=(0.4, 0.2)),
}
"""The upper left corner of the lower box sticks out, and the lower right one of the upper box."""

CORNER = 0.2 + 0.2j
"""The upper right corner of the lower box, on which the upper one lies [m]."""


def heights(place: Array, upper: int) -> list[float]:
    """Return how high the upper box is above that corner, and its own above the lower box [m]."""
    there = Coordinates(place)
    center, turned = complex(there.position[upper]), complex(there.rotation[upper])
    tip = center + (-0.2 - 0.1j) * turned
    return [tip.imag - 0.2, -((CORNER - center) * turned.conjugate()).imag - 0.1]


@pytest.mark.parametrize("leans", [0.0, 1e-3])
@pytest.mark.parametrize("names", [("lower", "upper"), ("upper", "lower")])
def test_each_point_of_two_sides_has_its_own_side(names: tuple[str, str], leans: float) -> None:
    """One gap was that of a point that slides away: 6 mm off as the upper box slides and turns.

    So it is where sides lean by some rad: of one contact they have one normal, that of one side.
    """
    bodies = {name: STAIR[name] for name in ("ground", *names)}
    contact: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "rotation": {}}
    world = build(level(bodies, contact))
    world.advance()
    direct = world.scene.direct
    assert direct
    assert direct._taken
    kick, upper = direct._taken.kick, list(bodies).index("upper")
    place = kick.pose.values.copy()
    angle = len(place) // 3 * 2 + upper
    off = (complex(kick.pose.position[upper]) - CORNER) * (np.exp(1j * leans) - 1)
    place[[2 * upper, 2 * upper + 1, angle]] += off.real, off.imag, leans  # its corner comes down
    there = Coordinates(place)
    kick = direct._build.rebuilt(there, kick.contacts_at(there), kick.kept_lengths)
    way = np.zeros_like(place)
    way[2 * upper], way[angle] = 0.05, 0.1

    opened = (kick.rows(way).total - kick.rows_at_start.total)[kick.layout.gaps]

    on_lower = (kick.layout.touching.bodies > 0).all(axis=0)
    rises = np.subtract(heights(place + way, upper), heights(place, upper))
    assert sorted(opened[on_lower]) == pytest.approx(sorted(rises), abs=1e-7)  # m, the skin


def test_sides_are_remembered_for_these_bodies_and_this_friction_only() -> None:
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    ball = {"ball": disc((0, 0.5), friction=0.4), "ground": floor(friction=0.4)}
    world = build(level(ball, effects))
    world.advance()
    direct = world.scene.direct
    assert direct
    assert direct._taken
    touching, owner = direct._taken.kick.layout.touching, np.array([[False], [True]])

    known = touching.memory.recall(owner)

    assert known is not None
    assert known.is_owner.tolist() == [[0, 0], [1, 1]]  # the ground's, in the gap and in the slip
    assert touching.memory.recall(~owner) is None
    assert touching.with_friction_at(touching.friction_points).memory.recall(owner) is None
