"""Located impacts that come right at a step, or by rounding before or after it."""

from itertools import product
from math import sqrt

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.contacts.detection import time_of_impact
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from tests.physics.scenes import Spec, booked, disc, fixed, floor, level, run, worst

PULL = 8.0
"""m/s²: with it, falls of so many steps have few digits."""

ULP = 2.0**-52
OFF = [0, *(sign * off for off in (ULP, 4 * ULP, 1e-14, 1e-12) for sign in (1, -1)), 1e-10, 1e-8]
"""By which share a fall is longer than one that ends at a step. What stands proud by 1e-9 m is then
touched at the step, and the bounce is early by that share at the most."""

RATES = (60, 120, 480, 1920)
FLOORS: dict[str, Spec] = {
    "floor": floor(restitution=1),
    "one-way": {**floor(restitution=1), "one_way": "left"},
    "box": fixed({"type": "box", "width": 3, "height": 0.2}, (0, -0.1), restitution=1),
}


def effects(*names: str, **rest: object) -> Spec:
    gravity = {"acceleration": [0, -PULL]}
    return {"gravity": gravity, "contact": {"located": names}, "restitution": {}, **rest}


def falling(fall: float, rate: float, e: float, ground: Spec) -> Level:
    """A ball that falls so far."""
    ball = disc((0, fall + 0.125), radius=0.125, restitution=e)
    return level({"ball": ball, "ground": ground}, effects("ball"), stepping={"rate": rate})


def fall_of(steps: int, rate: float, off: float) -> float:
    """Return how far a ball falls in so many steps, and a share more [m]."""
    return PULL * (steps / rate) ** 2 / 2 * (1 + off)


def flown(world: World, steps: int) -> tuple[Snapshot, int]:
    """Return all states, and how many impacts were located."""
    states, count = [world.snapshot], 0
    for _ in range(steps):
        states.append(world.advance())
        count += len(world.impacts)
    return Snapshot.stack(states), count


def misses(rate: float, off: float, e: float, ground: Spec) -> tuple[float, float, int]:
    """Return by how much a bounce after 30 steps misses height and speed; and the impacts.

    Both relative to those of the fall, from the step of the impact on, and the height but there.
    """
    fall, steps = fall_of(30, rate, off), 30
    flight, count = flown(build(falling(fall, rate, e, ground)), 44)
    speed, after = sqrt(2 * PULL * fall), flight.t[steps:] - sqrt(2 * fall / PULL)
    height = flight.position[steps + 1 :, 0, 1] - 0.125
    expected = e * speed * after - PULL * after**2 / 2
    rates = np.abs(flight.velocity[steps + 1 :, 0, 1] - (e * speed - PULL * after[1:]))
    return np.abs(height - expected[1:]).max() / fall, rates.max() / speed, count


@pytest.mark.sweep
@pytest.mark.parametrize(("rate", "ground", "e"), [*product(RATES, FLOORS, (1.0, 0.5))])
def test_a_bounce_at_a_step_is_as_exact_as_any(rate: float, ground: str, e: float) -> None:
    for off in OFF:
        height, speed, count = misses(rate, off, e, FLOORS[ground])

        assert count == 1, off
        assert max(height, speed) <= 1e-11 + 4 * max(off, 0), off


def test_a_bounce_that_is_left_to_the_step_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """The check above can fail: drifts at whose end nothing overlaps lose impacts to pymunk."""
    monkeypatch.setattr(time_of_impact, "_rounding", lambda *_: -1.0)
    found = [misses(480, off, 0.5, FLOORS["floor"]) for off in OFF]

    assert max(height for height, _, _ in found) > 1e-3


@pytest.mark.parametrize("off", OFF)
def test_the_velocity_at_that_step_is_the_one_after_the_impact(off: float) -> None:
    fall = fall_of(30, 480, off)
    flight = run(build(falling(fall, 480, 1, FLOORS["floor"])), 44)
    energy = flight.velocity[:, 0, 1] ** 2 / 2 + PULL * (flight.position[:, 0, 1] - 0.125)

    assert flight.velocity[30, 0, 1] > 0
    assert worst(energy, PULL * fall) <= 1e-13


@pytest.mark.parametrize(("e", "off"), [*product((1.0, 0.5, 0.0), OFF)])
def test_balls_that_meet_at_a_step_part_e_times_as_fast(e: float, off: float) -> None:
    """One falls from rest, and one comes up: they approach evenly."""
    apart = 3.0 / 480 * 30 * (1 + off)
    bodies = {
        "above": disc((0, apart + 0.25), radius=0.125, mass=2, restitution=e),
        "below": disc((0, 0), radius=0.125, velocity=[0, 3], restitution=1),
    }
    world = build(level(bodies, effects("above"), stepping={"rate": 480}))
    flight, count = flown(world, 40)
    velocity = flight.velocity[32:, :, 1]

    assert count == 1
    assert np.abs(velocity[:, 0] - velocity[:, 1] - 3 * e).max() <= 1e-12
    assert np.abs(velocity @ [2, 1] - (3 - 3 * PULL * flight.t[32:])).max() <= 1e-12


@pytest.mark.parametrize("off", OFF)
def test_a_ball_that_spins_grips_the_ground_at_a_step(off: float) -> None:
    """What does not slip any more goes on with ω r / 3, for I = m r² / 2."""
    fall = fall_of(30, 480, off)
    ball = disc((0, fall + 0.125), radius=0.125, angular_velocity=-12, restitution=0.5, friction=1)
    ground = floor(restitution=1, friction=1)
    rest = effects("ball", friction={}, rotation={})
    world = build(level({"ball": ball, "ground": ground}, rest, stepping={"rate": 480}))
    flight, count = flown(world, 40)

    assert count == 1
    assert worst(flight.velocity[31:, 0, 0], 12 * 0.125 / 3) <= 1e-12
    assert worst(flight.angular_velocity[31:, 0], -4.0) <= 1e-12
    after = flight.t[31:] - sqrt(2 * fall / PULL)
    rises = sqrt(PULL * fall / 2) - PULL * after
    assert worst(flight.velocity[31:, 0, 1], rises) <= 1e-11 + 4 * max(off, 0)


@pytest.mark.parametrize(("speed", "off"), [*product((10.0, 1e3, 1e6), OFF)])
def test_no_bullet_that_arrives_at_a_step_passes(speed: float, off: float) -> None:
    way = speed / 64 * 3 * (1 + off)
    bullet = disc((-way - 0.03125, 0), radius=0.03125, velocity=[speed, 0], restitution=0.5)
    wall = fixed({"type": "box", "width": 0.001, "height": 9}, (0.0005, 0), restitution=1)
    contact = {"contact": {"located": ["bullet"]}, "restitution": {}}
    scene = level({"bullet": bullet, "wall": wall}, contact)
    flight, count = flown(build(scene), 6)

    assert count == 1
    assert worst(flight.velocity[-1, 0, 0], -speed / 2) <= 1e-12


@pytest.mark.sweep
@pytest.mark.parametrize("e", [1.0, 0.5])
def test_the_books_close_over_an_impact_at_a_step(e: float) -> None:
    for off in OFF:
        _, books = booked(falling(fall_of(30, 480, off), 480, e, FLOORS["floor"]), 44 / 480)

        balance = books.balance
        assert abs(balance.unexplained) <= 1e-14, off
        assert np.abs(balance.unexplained_impulse).max() <= 1e-13, off
        assert (balance.loss["impacts"] > 0.09) == (e < 1), off


def test_a_ball_that_bounces_for_long_comes_to_rest_in_contact() -> None:
    """Its first impact is at a step, and so are some of the later ones, nearly."""
    flight = run(build(falling(fall_of(30, 480, 0), 480, 0.5, FLOORS["one-way"])), 480)

    assert np.abs(flight.position[-48:, 0, 1] - 0.125).max() <= 1e-8
    assert worst(flight.normal[-48:, 0], PULL) <= 1e-9
