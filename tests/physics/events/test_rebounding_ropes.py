"""Ropes with a restitution: when they become taut, and what they take."""

from collections.abc import Callable
from math import log2

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, booked, box, disc, fixed, floor, level

ROPES: dict[str, Spec] = {
    "rope": {"type": "rope", "ends": [[0.3, 1], "ball"]},
    "pulley": {"type": "pulley", "ends": ["ball", [1, 0]], "over": [[0.3, 1]]},
    "winding": {
        "type": "winding",
        "ends": ["ball", "wheel"],
        "radius": 0.3,
        "unwinds": "clockwise",
    },
}


@pytest.mark.parametrize("e", [0, 0.6, 1])
@pytest.mark.parametrize("kind", ROPES)
def test_a_ball_thrown_up_on_its_rope_rebounds_with_the_share_that_newton_says(
    kind: str, e: float
) -> None:
    """It is back after 2 v / g, and rises with e v: the parabolas are exact."""
    bodies = {
        "ball": disc((0.3, 0), radius=0.1, velocity=[0, 2]),
        "wheel": fixed({"type": "disc", "radius": 0.3}, (0, 1)),
    }
    rope = {**ROPES[kind], "restitution": e}
    world, books = booked(level(bodies, GRAVITY, joints={"rope": rope}), 0.6)
    since = world.t - 4 / G

    rises = 2 * e * since - G * since**2 / 2 if e else 0.0
    assert world.snapshot.position[0] == pytest.approx([0.3, rises], abs=1e-12)
    assert books.balance.loss["impacts"] == pytest.approx(2 * (1 - e**2), abs=1e-12)
    assert abs(books.balance.unexplained) < 1e-12


def flung(**rope: object) -> Level:
    """Two balls on a rod, flung until a slack rope catches one of them."""
    bodies = {
        "near": disc((0.31, 0), velocity=[2, 1]),
        "far": disc((0.81, 0), mass=3, velocity=[2, 1]),
    }
    joints = {
        "rope": {"type": "rope", "ends": [[0, 0], "near"], "length": 1, **rope},
        "rod": {"type": "rod", "ends": ["near", "far"]},
    }
    return level(bodies, GRAVITY, joints=joints)


def towed(**rope: object) -> Level:
    """A crate that slides ahead, until a slack rope at its edge tows another one."""
    bodies = {
        "floor": floor(friction=1),
        "first": box((0, 0.2), size=(1, 0.4), mass=9, velocity=[3, 0], friction=0.2),
        "second": box((-1.2, 0.2), size=(1, 0.4), mass=3, friction=0.5),
    }
    ends = [{"body": "second", "at": [0.5, 0.1]}, {"body": "first", "at": [-0.5, -0.1]}]
    joints = {"rope": {"type": "rope", "ends": ends, "length": 0.37, **rope}}
    effects = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
    return level(bodies, effects, joints=joints)


def errors(scene: Level, rates: tuple[int, ...] = (120, 240, 480)) -> list[float]:
    """Return the errors of positions after 0.8 s, from a run at 1920 Hz [m]."""
    places = []
    for rate in (*rates, 1920):
        world = build(scene, stepping=scene.stepping.at(rate))
        places.append(world.advance(int(0.8 * rate)).position)
    return [float(np.abs(place - places[-1]).max()) for place in places[:-1]]


@pytest.mark.parametrize("e", [0, 0.5])
def test_a_rope_that_is_caught_among_other_joints_is_of_second_order(e: float) -> None:
    coarse, _, fine = errors(flung(restitution=e))

    assert log2(coarse / fine) / 2 > 1.9


@pytest.mark.parametrize(("scene", "closer"), [(flung, 8), (towed, 100)])
def test_a_rope_that_is_caught_at_the_end_of_the_step_is_less_accurate(
    scene: Callable[..., Level], closer: float
) -> None:
    """Measured at 480 Hz: 13 and 1,700 times."""
    assert errors(scene())[2] > closer * errors(scene(restitution=0))[2]


def test_a_rope_of_pymunks_own_has_no_restitution() -> None:
    with pytest.raises(LevelError, match="only an exact rope has a 'restitution'"):
        flung(restitution=0, exact=False)


def test_a_rope_that_rebounds_shares_no_level_with_contacts_in_turn() -> None:
    rope = {**ROPES["rope"], "restitution": 0}
    with pytest.raises(LevelError, match="needs the 'direct' solver of contacts"):
        level({"ball": disc()}, {"contact": {"solver": "iterative"}}, joints={"rope": rope})
