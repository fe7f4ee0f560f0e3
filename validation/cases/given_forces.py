"""Drag, given forces, a movable pulley, and a skater who draws in the arms."""

from collections.abc import Iterator

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.case import SECOND_ORDER, Case, Choices, Expected
from validation.formulas import lagrange, momentum, newton

FALLS: Choices = ({}, {"m": 5.0, "c": 0.1}, {"c": 1.0, "g": 25.0})
PULLEYS: Choices = ({}, {"m": 0.5, "M": 10.0}, {"m": 5.0, "M": 0.5, "g": 1.0})
FORCES: Choices = (
    {},
    {"m": 0.5, "F1x": -6.0, "F1y": 6.0, "F2x": 6.0, "F2y": 6.0},
    {"m": 10.0, "F1x": 0.3, "F1y": -5.7, "F2x": 0.0, "F2y": 0.0},
)
SECOND = "second order though the force needs the velocity: (dt/τ)² of the scale, 1e-4"


def cases() -> Iterator[Case]:
    """Yield the cases of given forces."""
    for parameters in FALLS:
        yield Case(
            name="terminal velocity: velocity at every step",
            level="newton/terminal-velocity",
            parameters=parameters,
            quantity="ball.velocity.y",
            expected=lambda p, t: newton.fall_velocity(t, p["m"], p["c"], p["g"]),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=1e-4,
        )
    yield from _thrown()
    yield from _pushed()
    yield from _pulleys()
    yield Case(
        name="skater: angular momentum",
        level="rotation/skater",
        quantity="system.angular_momentum",
        expected=lambda p, _: 2 * p["v"],
        tolerance=1e-12,
        because="every impulse points to the axis from where the hands are",
    )
    yield Case(
        name="skater: speed of a hand",
        level="rotation/skater",
        quantity="right.speed",
        expected=lambda p, t: lagrange.skater_speed(t, p["v"], p["u"]),
        tolerance=1e-5,
        order=SECOND_ORDER,
        because="second order: the hand's own turn in a step, squared, as it changes",
        naive_misses=1e-4,
    )


def _thrown() -> Iterator[Case]:
    for axis, component, g in (("x", 1 + 0j, 0.0), ("y", 1j, 9.81)):
        yield Case(
            name=f"throw with linear drag: {axis} at every step",
            level="newton/projectile-with-drag",
            quantity=f"ball.position.{axis}",
            expected=_throw(component, g),
            tolerance=2e-5,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=1e-4,
        )


def _throw(direction: complex, g: float) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        velocity = p["speed"] * np.exp(1j * np.radians(p["angle"]))
        along = float((velocity * direction.conjugate()).real)
        return newton.throw_with_drag(t, along, p["m"], p["c"], g)

    return expected


def _pushed() -> Iterator[Case]:
    yield Case(
        name="force over time: momentum at every step",
        level="momentum/force-profile",
        quantity="box.momentum.x",
        expected=lambda p, t: momentum.half_sine_momentum(t, p["F"], p["T"]),
        tolerance=1e-4,
        order=SECOND_ORDER,
        because="a trapezoidal sum: (π dt / T)² / 12, 1.4e-5 for T = 1 s",
        naive_misses=5e-4,
    )
    for parameters in FORCES:
        for index, axis in enumerate("xy"):
            yield Case(
                name=f"two forces: acceleration, {axis}",
                level="newton/two-forces",
                parameters=parameters,
                quantity=f"box.acceleration.{axis}",
                expected=_accelerated(index),
                tolerance=1e-11,
                because="exact; a difference of velocities over dt",
            )


def _accelerated(index: int) -> Expected:
    return lambda p, _: newton.resultant((p["F1x"], p["F1y"]), (p["F2x"], p["F2y"]))[index] / p["m"]


def _pulleys() -> Iterator[Case]:
    for parameters in PULLEYS:
        yield Case(
            name="movable pulley: height at every step",
            level="newton/compound-pulley",
            parameters=parameters,
            quantity="wheel.position.y",
            expected=lambda p, t: (
                newton.movable_pulley_acceleration(p["m"], p["M"], p["g"]) * t**2 / 2
            ),
            tolerance=1e-11,
            because="the string is straight: one Newton step solves it, to rounding",
            naive_misses=1e-3,
        )
