"""Forces that depend on velocities, where a landing changes these within a step."""

from math import acosh, atan, cos, exp, log, sqrt, tanh

import numpy as np
import pytest

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, booked, disc, floor, level

DRAG = 0.5
"""kg/m, of a ball of 1 kg that falls by a metre and bounces with 0.7 of its speed"""


def bounced(rate: float) -> tuple[World, Ledger]:
    effects = {
        **GRAVITY,
        "contact": {"solver": "direct"},
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


@pytest.mark.parametrize("rate", [60, 120, 240, 480])
def test_drag_acts_with_the_velocities_before_and_after_a_bounce(rate: int) -> None:
    """It took their mean for that after the bounce: 1e-2 m off at 120 Hz, 1e-3 at 480."""
    world, books = bounced(rate)
    allowed = 5e-4 * (60 / rate) ** 2  # 2e-4, 5e-5, 2e-5, 6e-7

    assert world.snapshot.position[1, 1] == pytest.approx(height(0.7), abs=allowed)
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11
    assert abs(books.balance.unexplained) < 1e-12
