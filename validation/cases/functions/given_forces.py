"""The functions that the tables of `given_forces.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import newton, pulleys, rotation

RING = 2.0  # m


def throw(direction: complex, g: float) -> Expected:
    """Return the closed form of a throw with drag, as the distance along a direction [m]."""

    def expected(p: Values, t: Array) -> Array:
        velocity = p["speed"] * np.exp(1j * np.radians(p["angle"]))
        along = float((velocity * direction.conjugate()).real)
        return newton.throw_with_drag(t, along, p["m"], p["c"], g)

    return expected


def accelerated(index: int) -> Expected:
    """Return the closed form of a component of the acceleration [m/s²]."""
    return lambda p, _: newton.resultant((p["F1x"], p["F1y"]), (p["F2x"], p["F2y"]))[index] / p["m"]


def lifted(times: float) -> Expected:
    """Return the closed form of a distance, as a multiple of the wheel's [m]."""
    return lambda p, t: (
        times * pulleys.movable_pulley_acceleration(p["m"], p["M"], p["g"]) * t**2 / 2
    )


def height(index: int, start: float) -> Expected:
    """Return the closed form of the height of a mass [m]."""

    def expected(p: Values, t: Array) -> Array:
        masses = p["m1"], p["M"], p["m2"], p["m3"]
        return start + pulleys.double_atwood_accelerations(*masses, p["g"])[index] * t**2 / 2

    return expected


def spun_up(p: Values, _: Array) -> float:
    """Return the speed on the rim [m/s]: I ω = I' ω', with the moments of two rings."""
    size = RING / p["n"]
    before, after = (rotation.round_moment(rotation.HOOP, 8.0, r) for r in (RING, size))
    return before * p["spin"] / after * size
