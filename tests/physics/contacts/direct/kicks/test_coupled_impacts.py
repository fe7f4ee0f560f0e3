"""Impacts of a step that joints take part in."""

import pytest

from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, box, floor, level


def angle(rate: float, turns: str) -> float:
    """Return how a dropped box has turned after 0.4 s, with a heavy arm on its motor [rad]."""
    size = 0.4
    bodies = {
        "a": box((0, 0.55), size=(size, size), angle=0.3, friction=1.5, restitution=0.8),
        "b": box((0, 0.95), size=(0.1, 0.8), mass=85, friction=1.5, restitution=0.8),
        "f": floor(friction=1, restitution=1),
    }
    effects = {
        **GRAVITY,
        "contact": {"jointed": False, "apart": [["b", "f"]]},
        "friction": {},
        "restitution": {},
        "rotation": {},
    }
    ends = ["a", {"body": "b", "at": [0, -0.4]}]
    motor = {"m": {"type": "motor", "ends": ends, "rate": turns}}
    scene = level(bodies, effects, joints=motor, stepping={"rate": rate}, duration=0.4)
    return float(build(scene).advance(round(0.4 * rate)).angle[0])


@pytest.mark.parametrize("turns", ["1.5*sin(3*t)", "2*t", "where(t < 0.1, 1, -2)"])
def test_what_a_motor_of_changing_rate_drives_bounces_with_the_rate_of_that_instant(
    turns: str,
) -> None:
    """With the mean rate of the drift after it, it was wrong by the change in a step.

    At 60, 120 and 240 Hz alike: by 1e-3 to 2e-4 rad.
    """
    exact = angle(1920, turns)
    errors = [abs(angle(rate, turns) - exact) for rate in (60, 120, 240)]

    assert errors[0] < 2e-6  # measured: 3e-7 for the smooth rates, 8e-7 for the jump
    assert errors[1] < errors[0] / 3
    assert errors[2] < errors[1] / 3
