"""Stops with a restitution beside bodies that land: both impacts at their own times."""

from itertools import pairwise
from math import cos, sin, sqrt

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from tests.physics.scenes import GRAVITY, G, Spec, booked, box, disc, floor, level

CONTACT: Spec = {**GRAVITY, "contact": {}, "rotation": {}, "friction": {}, "restitution": {}}


def lever(rate: float) -> Level:
    """100 kg fall on a lever of 1 kg, which meets its stop with them."""
    rubs: Spec = {"friction": 0.4, "restitution": 0.2}
    bodies = {
        "arm": box((0.5, 1), size=(1, 0.05), **rubs),
        "ball": disc((0.85, 1.6), radius=0.08, mass=100, **rubs),
    }
    stop = {"type": "angle_stop", "ends": [[0, 0], "arm"], "range": [-0.6, 0.5]}
    joints = {
        "pin": {"type": "pivot", "ends": [[0, 1], {"body": "arm", "at": [-0.5, 0]}]},
        "stop": {**stop, "restitution": 0.5},
    }
    return level(bodies, CONTACT, joints=joints, stepping={"rate": rate}, duration=0.8)


def overlap(now: Snapshot) -> float:
    """Return how deep the ball is in the upper side of the lever, 0 beyond its end [m]."""
    (x, y), angle = now.position[1] - now.position[0], now.angle[0]
    beyond = x * cos(angle) + y * sin(angle) > 0.5
    return 0.0 if beyond else 0.08 + 0.025 - float(y * cos(angle) - x * sin(angle))


@pytest.mark.parametrize("rate", [60, 120, 480])
def test_a_lever_on_which_a_weight_lands_goes_no_further_than_its_stop(rate: float) -> None:
    """It was stopped at 60 and 120 Hz, and went 6e-4 rad too far at 480, 2.3 mm into the ball."""
    world, books = booked(lever(rate), 0)
    for _ in range(round(0.8 * rate)):
        now = world.advance()
        books.note()
        assert now.angle[0] >= -0.6 - 1e-12
        assert overlap(now) < 1e-6

    assert abs(books.balance.unexplained) < 0.5 * (60 / rate) ** 2  # J of 700; 0.25 to 2e-3 seen


@pytest.mark.sweep
def test_a_stop_met_beside_a_landing_is_of_second_order() -> None:
    """Measured: 1.7e-4, 4.2e-5, 1.0e-5 and 2.7e-6 m or rad; 6.1e-4 was the last one before."""
    rates = 60, 120, 240, 480, 960
    paths = []
    for rate in rates:
        world = build(lever(rate))
        seen = [world.advance(rate // 20) for _ in range(12)]
        paths.append(np.array([np.append(now.position.ravel(), now.angle) for now in seen]))
    steps = [np.abs(a - b).max() for a, b in pairwise(paths)]

    assert all(fine < coarse / 3.5 for coarse, fine in pairwise(steps))
    assert steps[-1] < 1e-5


def lift(gap: float, rate: float, restitution: float = 0.5, **buffer: object) -> Level:
    """A lift of 10 kg, 0.3 m above an elastic stop, and a ball just above it."""
    up = {"type": "stop", "ends": ["lift", [0, 0]], "direction": [0, 1], "range": [0, 9]}
    bounces = {"restitution": restitution}
    bodies = {
        "lift": box((0, 0.3), size=(1, 0.1), mass=10, **bounces),
        "ball": disc((0, 0.3 + 0.05 + 0.1 + gap), radius=0.1, **bounces),
    }
    joints = {"buffer": {**up, "restitution": 0.5, **buffer}}
    effects = {**GRAVITY, "contact": {}, "restitution": {}}
    return level(bodies, effects, joints=joints, stepping={"rate": rate})


@pytest.mark.parametrize("rate", [60, 240])
def test_a_ball_lands_on_a_lift_that_has_just_bounced(rate: float) -> None:
    """The lift bounces, and the ball lands 1 ms later: both exact but for the skin of 1e-8 m."""
    bounce, wait, e, rebound = sqrt(0.6 / G), 1e-3, 0.5, 0.25
    speed = G * bounce
    rises, falls = e * speed - G * wait, -G * (bounce + wait)
    middle, change = (10 * rises + falls) / 11, rebound * (rises - falls)
    height, left = e * speed * wait - G * wait**2 / 2, 0.3 - bounce - wait

    def after(start: float, velocity: float) -> float:
        return start + velocity * left - G * left**2 / 2

    world, books = booked(lift(speed * (1 + e) * wait, rate), 0.3)
    lift_at, ball_at = world.snapshot.position[:, 1]

    assert lift_at == pytest.approx(after(height, middle - change / 11), abs=2e-8)
    ball_start = height + 0.15
    assert ball_at == pytest.approx(after(ball_start, middle + change * 10 / 11), abs=2e-8)
    assert abs(books.balance.unexplained) < 1e-7


@pytest.mark.parametrize("rate", [60, 240])
def test_a_lift_with_its_load_comes_to_rest_on_its_buffer(rate: float) -> None:
    world, books = booked(lift(0.2, rate), 4)

    assert world.snapshot.position[:, 1] == pytest.approx([0, 0.15], abs=2e-8)
    assert np.abs(world.snapshot.velocity).max() < 1e-8
    assert books.balance.unexplained == pytest.approx(0, abs=2e-2)


def test_a_stop_met_too_often_in_a_step_is_named() -> None:
    stop = {"type": "stop", "ends": ["puck", [0, 0]], "direction": [1, 0], "range": [-1e-3, 1e-3]}
    bodies = {"puck": disc(velocity=[100, 0]), "floor": floor(-0.5)}
    joints = {"stop": {**stop, "restitution": 1}}

    with pytest.raises(SimulationError, match="'stop'; reduce their 'restitution', or give"):
        build(level(bodies, {**GRAVITY, "contact": {}}, joints=joints))
