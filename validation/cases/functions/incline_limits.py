"""The functions that the tables of `incline_limits.toml` name under `own`."""

from math import radians

from sandbox.model.expressions import Values
from validation.case import Expected
from validation.formulas import newton
from validation.formulas.arrays import Array

START = 6.0  # m, along the ramp from its foot, where a block's face begins


def along(p: Values, t: Array) -> Array:
    """Return the distance of the block from the foot of the ramp [m]."""
    return START - newton.incline_acceleration(radians(p["angle"]), p["g"]) * t**2 / 2


def acceleration(p: Values, _: Array) -> float:
    """Return the acceleration along the ramp [m/s²]."""
    return newton.incline_acceleration(radians(p["angle"]), p["g"])


def x(above: float) -> Expected:
    """Return the closed form of a block's horizontal position, given half its height [m]."""
    return lambda p, t: newton.incline_point(along(p, t), above, radians(p["angle"]))
