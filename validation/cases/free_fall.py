"""Free fall: exact for leapfrog, late by half a step for pymunk as it comes."""

from collections.abc import Iterator

from validation.case import Case, Choices
from validation.formulas import kinematics

PARAMETERS: Choices = (
    {},
    {"height": 50.0, "g": 25.0, "mass": 0.1},
    {"height": 1.0, "g": 1.0, "mass": 100.0},
)


def cases() -> Iterator[Case]:
    """Yield the cases of free fall."""
    for parameters in PARAMETERS:
        yield Case(
            name="free fall: height at every step",
            level="kinematics/free-fall",
            parameters=parameters,
            quantity="ball.position.y",
            expected=lambda p, t: kinematics.free_fall_height(p["height"], p["g"], t),
            tolerance=1e-12,
            because="leapfrog is exact for constant acceleration; some hundred roundings of 1e-16",
            naive_misses=1e-3,  # g t dt / 2, at the end 0.165 m of 20 m
        )
        yield Case(
            name="free fall: velocity at every step",
            level="kinematics/free-fall",
            parameters=parameters,
            quantity="ball.velocity.y",
            expected=lambda p, t: kinematics.free_fall_velocity(p["g"], t),
            tolerance=1e-12,
            because="a sum of equal kicks; pymunk's own is as good",
        )
