"""Forces that depend on velocities, where located impacts divide a drift into flights."""

from itertools import pairwise

import numpy as np
import pytest

from tests.physics.scenes import GRAVITY, Spec, booked, disc, fixed, floor, level

SPEED, DRAG = 6.0, 0.217
"""The speed of a ball of 1 kg [m/s], and its quadratic drag [kg/m]"""


@pytest.mark.parametrize("room", [0.012, 0.1, 0.8])
@pytest.mark.parametrize("rate", [60, 240])
def test_a_ball_that_rattles_loses_what_it_would_lose_on_a_straight_way(
    room: float, rate: int
) -> None:
    """It kept 5.8 of 6 m/s in 12 mm, as each flight had the drag of the first one in its step."""
    wall: Spec = {"type": "segment", "start": [0, -1], "end": [0, 1]}
    bodies = {
        name: fixed(wall, position=[side * (0.1 + room / 2), 0], restitution=1)
        for name, side in (("left", -1), ("right", 1))
    }
    ball = disc((room / 20, 0), radius=0.1, velocity=[SPEED, 0], restitution=1)
    effects = {"contact": {"located": ["ball"]}, "restitution": {}, "drag": {"quadratic": DRAG}}
    world, books = booked(level({**bodies, "ball": ball}, effects, stepping={"rate": rate}), 0.5)

    expected = SPEED / (1 + DRAG * SPEED * 0.5)
    allowed = 2e-6 + 2e-4 * (60 / rate) ** 2  # 1e-6, 4e-5, 1.5e-4 at 60 Hz
    assert abs(world.snapshot.velocity[-1, 0]) == pytest.approx(expected, rel=allowed)
    assert abs(books.balance.unexplained) < 1e-12
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11


@pytest.mark.sweep
def test_a_damper_between_balls_that_bounce_is_of_second_order() -> None:
    """Its force was that before the bounce up to the next step: 0.02 m off at 240 Hz."""
    places = []
    for rate in (240, 480, 960):
        bodies = {
            "ground": floor(restitution=1),
            "heavy": disc((0, 1.1), radius=0.1, restitution=0.7),
            "light": disc((0.3, 1.6), radius=0.1, mass=0.2, restitution=0.7),
        }
        spring = {"type": "spring", "ends": ["heavy", "light"], "stiffness": 60, "length": 0.5}
        effects = {**GRAVITY, "contact": {"located": ["heavy", "light"]}, "restitution": {}}
        scene = level(
            bodies,
            {**effects, "rotation": {}},
            joints={"spring": {**spring, "damping": 1.5}},
            stepping={"rate": rate},
        )
        world, books = booked(scene, 0.9)
        places.append(world.snapshot.position[1:])
        assert np.abs(books.balance.unexplained_impulse).max() < 1e-11

    first, second = (np.abs(one - other).max() for one, other in pairwise(places))
    assert first < 2e-3  # 8e-4 m
    assert second < first / 3  # 7e-5 m


def test_a_charge_that_bounces_turns_on_as_its_velocity_says() -> None:
    """The field turned the velocity before the bounce up to the next step: 1e-2 m off at 240 Hz."""
    places = []
    for rate in (120, 240, 480):
        ball = disc((0, 1.1), radius=0.1, velocity=[1, 0], restitution=0.7)
        effects = {
            **GRAVITY,
            "contact": {"located": ["ball"]},
            "restitution": {},
            "magnetic": {"field": 3, "charges": [{"body": "ball", "charge": 1}]},
        }
        bodies = {"ground": floor(restitution=1), "ball": ball}
        world, books = booked(level(bodies, effects, stepping={"rate": rate}), 0.7)
        places.append(world.snapshot.position[-1])
        assert abs(books.balance.unexplained) < 1e-3 * (120 / rate) ** 2  # 7e-4 J at 120 Hz

    first, second = (np.abs(one - other).max() for one, other in pairwise(places))
    assert first < 1e-4  # 5e-5 m
    assert second < first / 3  # 1e-5 m
