"""A scene in a mirror does what the scene does, in the mirror."""

from collections.abc import Sequence

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.contacts.direct.test_solver import car
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, level

ROUGH: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
GROUND = fixed({"type": "box", "width": 40, "height": 1}, (0, -0.5), friction=1)


def dominoes(way: int, rate: float, speed: float, spin: float) -> Level:
    """Four slabs in a row, the first of which is pushed, to the right or, with -1, to the left."""
    slabs = {f"slab{i}": box((way * 0.3 * i, 0.3), size=(0.1, 0.6), friction=0.7) for i in range(4)}
    slabs["slab0"] |= {"velocity": [way * speed, 0], "angular_velocity": -way * spin}
    return level({"ground": GROUND, **slabs}, ROUGH, stepping={"rate": rate})


def apart(one: Level, other: Level, steps: int, images: Sequence[int]) -> float:
    """Return how far a run is from the mirror image of another, at any step [m, rad].

    Each body of the one is told whose image it is.
    """
    first, second = build(one), build(other)
    order = list(images)
    worst = 0.0
    for _ in range(steps):
        here, there = first.advance(), second.advance()
        worst = max(
            worst,
            float(np.abs(here.position - there.position[order] * [-1, 1]).max()),
            float(np.abs(here.angle + there.angle[order]).max()),
        )
    return worst


@pytest.mark.sweep
@pytest.mark.parametrize(("speed", "spin"), [(0.45, 1.5), (0.0, 1.5), (0.8, 0.0)])
def test_dominoes_fall_to_the_left_as_to_the_right(speed: float, spin: float) -> None:
    """Rubbed where its first point had left the floor, a slab slid by the way it turned, squared.

    That was 3e-4, 3e-7 and 6e-5 off.
    """
    right, left = (dominoes(way, 60, speed, spin) for way in (1, -1))

    assert apart(right, left, 36, range(5)) <= 1e-9  # 1e-14, 3e-14, 2e-10


@pytest.mark.sweep
def test_a_car_rolls_to_the_left_as_to_the_right() -> None:
    right, left = (car(1000, 240, velocity=[way, 0]) for way in (1.5, -1.5))

    assert apart(right, left, 200, (0, 1, 3, 2)) <= 1e-12  # 1e-14; wheels change places


def loaded_car(way: int) -> Level:
    """A car with a box on it, whose motor drives it over bumps, to the right or, with -1, left."""
    xs = [0.05 * i for i in range(60)]
    bumps = [[way * x, 0.04 * np.sin(2 * np.pi * x / 0.8) ** 2] for x in xs]
    road = {"type": "polyline", "points": [[-3 * way, 0], *bumps, [6 * way, 0]]}
    car = {
        "frame": box((-way, 0.35), size=(1.2, 0.2), mass=12, friction=0.8),
        "rear": disc(((-1 - 1.2 / 3) * way, 0.2), radius=0.2, mass=1.5, friction=0.8),
        "front": disc(((-1 + 1.2 / 3) * way, 0.2), radius=0.2, mass=1.5, friction=0.8),
        "load": box((-way, 0.55), size=(0.3, 0.2), mass=2, friction=0.8),
    }
    axles = {
        f"axle_{name}": {"type": "pivot", "ends": [{"body": "frame", "at": [way * x, -0.15]}, name]}
        for name, x in (("rear", -1.2 / 3), ("front", 1.2 / 3))
    }
    drive = f"{-way}*max(-6, min(6, 4*(8 + ({way})*omega)))"
    effects = {
        **ROUGH,
        "contact": {"jointed": False},
        "torque": [{"body": "front", "torque": drive, "against": "frame"}],
    }
    bodies = {"road": fixed(road, friction=1), **car}
    return level(bodies, effects, joints=axles, stepping={"rate": 120})


@pytest.mark.sweep
def test_a_loaded_car_is_driven_over_bumps_to_the_left_as_to_the_right() -> None:
    """A wheel touched two lines of the road where they meet, and its slip ended on either.

    Each cut of the drift took that contact once more. From 1.3 s on, it was 1e-4 m off.
    """
    assert apart(loaded_car(1), loaded_car(-1), 180, range(5)) <= 1e-9
