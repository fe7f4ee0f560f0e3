"""Events in the step of a landing: they take nothing from the bounce, and none is missed."""

from math import sqrt
from typing import Any

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, booked, disc, floor, level

FALL = sqrt(2 / G)
"""s, from a metre above the ground down to it"""

SPEED = G * FALL / 2
"""m/s, after a bounce with half of the velocity"""

BOUNCED = 0.6
"""s, the time at which the bounce is judged"""


def bouncing(rate: float, at: object, *, second: float = 0) -> Level:
    """A ball above the ground, and another one far away that a force pushes until an event."""
    balls: dict[str, Any] = {
        "ball": disc((0, 1.1), radius=0.1, restitution=0.5),
        "far": disc((5, 50), radius=0.1, restitution=0.5),
    }
    if second:
        height = 0.1 + G * second**2 / 2
        balls["second"] = disc((3, height), radius=0.1, restitution=0.5)
    push = [{"body": "far", "force": [1, 0], "name": "push"}]
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "restitution": {}, "force": push}
    events = {"event": {"at": at, "off": ["push"]}}
    bodies = {"ground": floor(restitution=1), **balls}
    return level(bodies, effects, events=events, stepping={"rate": rate})


def crossing(quantity: str, value: float, direction: str) -> dict[str, object]:
    return {"event": "crossing", "quantity": quantity, "value": value, "direction": direction}


def dumbbell(rate: float) -> Level:
    """Two balls on an upright rod, which is cut when they bounce."""
    bodies = {
        "ground": floor(restitution=1),
        "ball": disc((0, 1.1), radius=0.1, restitution=0.5),
        "load": disc((0, 2.1), radius=0.1, mass=2, restitution=0.5),
    }
    effects = {**GRAVITY, "contact": {}, "restitution": {}}
    joints = {"rod": {"type": "rod", "ends": ["ball", "load"]}}
    events = {"event": {"at": crossing("ball.velocity.y", 0, "up"), "cut": ["rod"]}}
    return level(bodies, effects, joints=joints, events=events, stepping={"rate": rate})


def happened(this: Level, seconds: float = BOUNCED) -> float | None:
    world = build(this)
    world.advance(round(seconds * this.stepping.rate))
    return world.scene.event_times.get("event")


def assert_bounced(this: Level) -> None:
    """The ball rises as if nothing had happened elsewhere, and the books close."""
    world, ledger = booked(this, BOUNCED)
    t = BOUNCED - FALL
    assert world.snapshot.position[1, 1] == pytest.approx(0.1 + SPEED * t - G * t**2 / 2, abs=1e-7)
    assert abs(ledger.balance.unexplained) < 1e-4
    assert "event" in world.scene.event_times


@pytest.mark.parametrize("share", [0.02, 0.3, 0.5, 0.9])
def test_what_happens_in_the_step_of_a_bounce_takes_nothing_from_it(share: float) -> None:
    """At 60 Hz it took 8 to 9 of 10 J, whichever body the event was about."""
    assert_bounced(bouncing(60, (int(60 * FALL) + share) / 60))


def test_what_happens_between_two_landings_in_a_row_takes_nothing_from_either() -> None:
    step = int(60 * FALL)
    this = bouncing(60, (step + 0.5) / 60, second=(step + 1.5) / 60)
    assert_bounced(this)
    again = build(this)
    again.advance(round(60 * BOUNCED))
    alone = build(bouncing(60, 0.1, second=(step + 1.5) / 60))
    alone.advance(round(60 * BOUNCED))
    after, before = (world.snapshot.position[3, 1] for world in (again, alone))
    assert after == pytest.approx(before, abs=1e-12)


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize(
    ("quantity", "value", "direction"),
    [
        ("ball.velocity.y", 0, "up"),  # the bounce itself
        ("ball.velocity.y", 2.1, "down"),  # soon after it
        ("ball.position.y", 0.101, "down"),  # just before it
        ("ball.position.y", 0.101, "up"),
        ("ball.position.y", 0.12, "up"),
    ],
)
def test_a_crossing_around_a_bounce_is_found_within_a_step(
    rate: float, quantity: str, value: float, direction: str
) -> None:
    """Several of these came at the next bounce, or never."""
    if quantity == "ball.velocity.y":
        exact = FALL + ((SPEED - value) / G if value else 0)
    elif direction == "down":
        exact = sqrt(2 * (1.1 - value) / G)
    else:
        exact = FALL + (SPEED - sqrt(SPEED**2 - 2 * G * (value - 0.1))) / G
    this = bouncing(rate, crossing(quantity, value, direction))
    found = happened(this)
    assert found is not None
    assert -1e-5 < (found - exact) * rate <= 1
    assert_bounced(this)


@pytest.mark.parametrize("value", [0.099, 0.09, 0.05])
def test_what_would_be_crossed_only_below_the_ground_does_not_happen(value: float) -> None:
    assert happened(bouncing(60, crossing("ball.position.y", value, "down"))) is None


@pytest.mark.parametrize("rate", [60, 240])
def test_a_rod_that_is_cut_at_a_bounce_leaves_both_bodies_their_velocities(rate: float) -> None:
    """Two balls on a rod bounce as one; cut there, both rise as before. They lost 29 J."""
    world, ledger = booked(dumbbell(rate), BOUNCED)
    t = BOUNCED - FALL
    rise = SPEED * t - G * t**2 / 2
    assert world.snapshot.position[1:, 1] == pytest.approx([0.1 + rise, 1.1 + rise], abs=1e-7)
    assert abs(ledger.balance.unexplained) < 1e-9


def coupled(rate: float, what: str, at: float) -> Level:
    """A ball above the ground, and far away two weights on a rod, whose rope is cut or tied."""
    bodies = {
        "ground": floor(restitution=1),
        "ball": disc((0, 1.1), radius=0.1, restitution=0.5),
        "weight": disc((9, 10), radius=0.1, mass=2, restitution=0.5),
        "other": disc((9.5, 10), radius=0.1, restitution=0.5, velocity=[0, float(what == "tie")]),
    }
    joints = {
        "rope": {"type": "rope", "ends": [[9, 12], "weight"]},
        "rod": {"type": "rod", "ends": ["weight", "other"]},
    }
    effects = {**GRAVITY, "contact": {}, "restitution": {}}
    events = {"event": {"at": at, what: ["rope"]}}
    return level(bodies, effects, joints=joints, events=events, stepping={"rate": rate})


@pytest.mark.parametrize("what", ["cut", "tie"])
def test_a_rope_that_is_cut_or_tied_at_the_step_before_a_bounce_leaves_it_alone(what: str) -> None:
    """The books could not add up the forces of two ropes and one, and a tied one hid the ground."""
    at = int(240 * FALL) / 240
    world, ledger = booked(coupled(240, what, at), BOUNCED)
    t = BOUNCED - FALL

    assert world.scene.event_times["event"] == pytest.approx(at, abs=1e-12)
    assert world.snapshot.position[1, 1] == pytest.approx(0.1 + SPEED * t - G * t**2 / 2, abs=1e-7)
    assert np.abs(ledger.balance.unexplained_impulse).max() < 1e-11
    assert abs(ledger.balance.unexplained) < 2e-3


@pytest.mark.parametrize("what", ["cut", "tie"])
def test_the_books_of_such_a_step_close_to_second_order(what: str) -> None:
    def open_by(rate: int) -> float:
        ledger = booked(coupled(rate, what, int(60 * FALL) / 60), BOUNCED)[1]
        return abs(ledger.balance.unexplained)

    assert open_by(60) > 12 * open_by(240) > 0
