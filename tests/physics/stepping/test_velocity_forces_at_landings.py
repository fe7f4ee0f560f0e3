"""Forces that depend on velocities, where a landing changes these within a step."""

from math import acosh, atan, cos, exp, log, sqrt, tanh

import numpy as np
import pytest

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, booked, disc, floor, level

DRAG = 0.5
"""kg/m, of a ball of 1 kg that falls by a metre and bounces with 0.7 of its speed"""


def bounced(rate: float, contact: Spec) -> tuple[World, Ledger]:
    effects = {
        **GRAVITY,
        "contact": contact,
        "restitution": {},
        "drag": {"quadratic": DRAG},
    }
    bodies = {"ground": floor(restitution=1), "ball": disc((0, 1.1), radius=0.1, restitution=0.7)}
    return booked(level(bodies, effects, stepping={"rate": rate}), 0.7)


def height(t: float) -> float:
    """Return the height of the ball: y = v²/g ln cos, after a fall of v²/g ln cosh."""
    terminal = sqrt(G / DRAG)
    falls = acosh(exp(G / terminal**2)) * terminal / G
    begins = atan(0.7 * tanh(G * falls / terminal))
    later = begins - G * (t - falls) / terminal
    return 0.1 + terminal**2 / G * log(cos(later) / cos(begins))


@pytest.mark.parametrize("contact", [{"solver": "direct"}, {"located": ["ball"]}])
@pytest.mark.parametrize("rate", [60, 120, 240, 480])
def test_drag_acts_with_the_velocities_before_and_after_a_bounce(rate: int, contact: Spec) -> None:
    """It took their mean for that after the bounce: 1e-2 m off at 120 Hz, 1e-3 at 480."""
    world, books = bounced(rate, contact)
    allowed = 5e-4 * (60 / rate) ** 2  # 2e-4, 5e-5, 2e-5, 6e-7

    assert world.snapshot.position[1, 1] == pytest.approx(height(0.7), abs=allowed)
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11
    assert abs(books.balance.unexplained) < 1e-12


def landed(rest: Spec, joints: dict[str, Spec], drag: float) -> tuple[World, Ledger]:
    """A ball bounces, beside other bodies."""
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "restitution": {}}
    if drag:
        effects["drag"] = {"quadratic": drag}
    ball = disc((0, 1.1), radius=0.1, restitution=0.7)
    bodies = {"ground": floor(restitution=1), **rest, "ball": ball}
    return booked(level(bodies, effects, stepping={"rate": 120}, joints=joints), 1.5)


def test_whoever_does_not_land_moves_as_if_nobody_had() -> None:
    """A body 50 m away was shifted by 1e-5 m, as its drag was taken at the times of the landing."""
    far, effects = disc((50, 40), radius=0.1), {**GRAVITY, "drag": {"quadratic": DRAG}}
    alone, _ = booked(level({"far": far}, effects, stepping={"rate": 120}), 1.5)
    beside, _ = landed({"far": {**far, "restitution": 0.7}}, {}, DRAG)

    assert (beside.snapshot.position[1] == alone.snapshot.position[0]).all()


def test_the_least_of_damping_changes_a_spring_at_a_landing_by_no_more() -> None:
    """The elastic force was taken along the drift as well: 7 mm, and damping gave 0.19 J."""
    ends, found = [[0, 2.5], "ball"], []
    for damping in (0.0, 1e-9):
        spring = {"type": "spring", "ends": ends, "stiffness": 100, "length": 1.4}
        found.append(landed({}, {"spring": {**spring, "damping": damping}}, 0.0))
    (without, _), (with_, books) = found

    shift = with_.snapshot.position[1] - without.snapshot.position[1]
    assert np.abs(shift).max() < 1e-7
    assert 0 <= books.balance.loss["damping"] < 1e-7
