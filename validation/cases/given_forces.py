"""Drag, given forces, movable pulleys, a skater who draws in the arms, and a star that shrinks."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Expression, Values
from validation.case import SECOND_ORDER, Case, Choices, Expected, ends
from validation.formulas import lagrange, momentum, newton, rotation

FALLS: Choices = ({}, *ends("newton/terminal-velocity", "c"))
PULLEYS: Choices = ({}, {"m": 0.5, "M": 10.0, "g": 25.0}, {"m": 5.0, "M": 0.5, "g": 1.0})
DOUBLE: Choices = (
    {"m1": 5.0},
    {"m1": 8.0, "m2": 0.5, "m3": 4.0, "M": 0.2},
    {"m1": 0.5, "m2": 4.0, "m3": 3.0, "M": 4.0, "g": 25.0},
    {"m1": 5.0, "m3": 0.5, "g": 1.0},
)
FORCES: Choices = (
    {},
    {"m": 0.5, "F1x": -6.0, "F1y": 6.0, "F2x": 6.0, "F2y": 6.0},
    {"m": 10.0, "F1x": 0.3, "F1y": -5.7, "F2x": 0.0, "F2y": 0.0},
    *ends("newton/two-forces"),
)
STARS: Choices = ({}, {"spin": 0.8, "n": 4.0}, {"spin": 0.2, "n": 1.5})
RING = 2.0  # m
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
    yield from _double()
    yield from _collapsing()
    yield from _skater()


def _skater() -> Iterator[Case]:
    for parameters in ({}, *ends("rotation/skater"), *ends("rotation/skater", "u")):
        case = partial(Case, level="rotation/skater", parameters=parameters)
        yield case(
            name="skater: angular momentum",
            quantity="system.angular_momentum",
            expected=lambda p, _: 2 * p["v"],
            tolerance=1e-12,
            because="every impulse points to the axis from where the hands are",
        )
        yield case(
            name="skater: speed of a hand",
            quantity="right.speed",
            expected=lambda p, t: lagrange.skater_speed(t, p["v"], p["u"]),
            tolerance=1e-5,
            order=SECOND_ORDER,
            because="second order: the hand's own turn in a step, squared, as it changes",
            naive_misses=1e-4,
        )


def _thrown() -> Iterator[Case]:
    level = "newton/projectile-with-drag"
    for parameters in ({}, *ends(level), *ends(level, "c")):
        for axis, component, g in (("x", 1 + 0j, 0.0), ("y", 1j, 9.81)):
            yield Case(
                name=f"throw with linear drag: {axis} at every step",
                level=level,
                parameters=parameters,
                quantity=f"ball.position.{axis}",
                expected=_throw(component, g),
                tolerance=2e-5,
                order=SECOND_ORDER,
                because=SECOND,
                naive_misses=5e-5,
            )


def _throw(direction: complex, g: float) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        velocity = p["speed"] * np.exp(1j * np.radians(p["angle"]))
        along = float((velocity * direction.conjugate()).real)
        return newton.throw_with_drag(t, along, p["m"], p["c"], g)

    return expected


def _pushed() -> Iterator[Case]:
    for parameters in ({}, *ends("momentum/force-profile")):
        yield Case(
            name="force over time: momentum at every step",
            level="momentum/force-profile",
            parameters=parameters,
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
        case = partial(Case, level="newton/compound-pulley", parameters=parameters)
        straight = "the string is straight: one Newton step solves it, to rounding"
        for body, times in (("wheel", 1), ("weight", -2)):
            yield case(
                name=f"movable pulley: height of the {body} at every step",
                quantity=f"{body}.position.y",
                expected=_lifted(times),
                tolerance=1e-11,
                because=straight,
                naive_misses=1e-3,
            )
        yield case(
            name="movable pulley: acceleration of the wheel",
            quantity="wheel.acceleration.y",
            expected=lambda p, _: newton.movable_pulley_acceleration(p["m"], p["M"], p["g"]),
            tolerance=1e-10,
            because=straight,
        )
        yield case(
            name="movable pulley: tension",
            quantity="string.tension",
            expected=lambda p, _: newton.movable_pulley_tension(p["m"], p["M"], p["g"]),
            tolerance=1e-10,
            because=straight,
        )


def _lifted(times: float) -> Expected:
    return lambda p, t: (
        times * newton.movable_pulley_acceleration(p["m"], p["M"], p["g"]) * t**2 / 2
    )


def _double() -> Iterator[Case]:
    for parameters in DOUBLE:
        for index, (body, start) in enumerate({"left": 0, "first": -2, "second": -2}.items()):
            yield Case(
                name=f"Atwood on Atwood: height of the {body} one at every step",
                level="newton/double-atwood",
                parameters=parameters,
                quantity=f"{body}.position.y",
                expected=_height(index, start),
                tolerance=1e-11,
                because="straight strings, solved together: rounding",
                naive_misses=5e-4,
            )


def _height(index: int, start: float) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        masses = p["m1"], p["M"], p["m2"], p["m3"]
        return start + newton.double_atwood_accelerations(*masses, p["g"])[index] * t**2 / 2

    return expected


def _collapsing() -> Iterator[Case]:
    for parameters in STARS:
        yield Case(
            name="collapsing star: angular velocity, from I ω before and after",
            level="rotation/collapsing-star",
            parameters=parameters,
            quantity="east.speed",
            at=Expression(2.5),
            expected=_spun_up,
            tolerance=1e-12,
            because="impulses along the spokes have no torque about the centre",
        )


def _spun_up(p: Values, _: Array) -> float:
    """Return the speed on the rim [m/s]: I ω = I' ω', with the moments of two rings."""
    size = RING / p["n"]
    before, after = (rotation.round_moment(rotation.HOOP, 8.0, r) for r in (RING, size))
    return before * p["spin"] / after * size
