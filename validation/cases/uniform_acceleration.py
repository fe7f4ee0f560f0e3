"""Uniform acceleration along a line: position, velocity, and the velocity after a way."""

from collections.abc import Iterator

from sandbox.model.expressions import Expression
from sandbox.model.level import CrossingEvent
from validation.case import Case, Choices
from validation.formulas import kinematics

LEVEL = "kinematics/uniform-acceleration"
PARAMETERS: Choices = ({}, {"v0": 10.0, "a": -4.0}, {"v0": 0.0, "a": 4.0}, {"v0": 10.0, "a": 4.0})
WAY = 5.0  # m
THERE = CrossingEvent(
    event="crossing", quantity="cart.position.x", value=Expression(WAY), direction="up"
)


def cases() -> Iterator[Case]:
    """Yield the cases of uniform acceleration."""
    for parameters in PARAMETERS:
        yield Case(
            name="uniform acceleration: position at every step",
            level=LEVEL,
            parameters=parameters,
            quantity="cart.position.x",
            expected=lambda p, t: kinematics.uniform_position(p["v0"], p["a"], t),
            tolerance=1e-13,
            because="leapfrog is exact for constant acceleration; 240 roundings, 8e-15",
            naive_misses=1e-3,  # a t dt / 2
        )
        yield Case(
            name="uniform acceleration: velocity at every step",
            level=LEVEL,
            parameters=parameters,
            quantity="cart.velocity.x",
            expected=lambda p, t: kinematics.uniform_velocity(p["v0"], p["a"], t),
            tolerance=1e-13,
            because="a sum of equal kicks; pymunk's own is as good",
        )
        yield Case(
            name="uniform acceleration: velocity after 5 m",
            level=LEVEL,
            parameters=parameters,
            quantity="cart.velocity.x",
            at=THERE,
            expected=lambda p, _: kinematics.speed_after_way(p["v0"], p["a"], WAY),
            tolerance=1e-13,
            because="the cubic between steps is exact for a parabola and a straight line",
            naive_misses=3e-4,
        )
