"""Uniform motion round a circle: the acceleration that turning is, and the period."""

from collections.abc import Iterator

from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import kinematics

LEVEL = "kinematics/circular-motion"
PARAMETERS: Choices = ({}, {"r": 1.5, "speed": 4.0}, {"r": 4.0, "speed": 1.0})
ONCE_ROUND = CrossingEvent(event="crossing", quantity="puck.position.y", direction="up")


def cases() -> Iterator[Case]:
    """Yield the cases of circular motion."""
    for parameters in PARAMETERS:
        yield Case(
            name="circular motion: acceleration at every step",
            level=LEVEL,
            parameters=parameters,
            quantity="puck.acceleration",
            expected=lambda p, _: kinematics.centripetal_acceleration(p["speed"], p["r"]),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="twice the error of the radius, (ω dt)² / 2, which is at most 1.5e-5",
            naive_misses=3e-4,
        )
        yield Case(
            name="circular motion: place at every step",
            level=LEVEL,
            parameters=parameters,
            quantity="puck.position.x",
            expected=lambda p, t: kinematics.circular_position(p["speed"], p["r"], t)[0],
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="the angle runs ahead by (ω dt)² / 3, 1.0e-5 of itself: 6.4e-5 in 1.1 turns",
            naive_misses=3e-4,
        )
        yield Case(
            name="circular motion: period",
            level=LEVEL,
            parameters=parameters,
            quantity="t",
            at=ONCE_ROUND,
            expected=lambda p, _: kinematics.circular_period(p["speed"], p["r"]),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="second order in ω dt, measured (ω dt)² / 3: at most 1.0e-5",
        )
