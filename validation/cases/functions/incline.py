"""The functions that the tables of `incline.toml` name under `own`."""

from math import radians

from sandbox.model.expressions import Values
from validation.case import Expected
from validation.formulas import newton
from validation.formulas.arrays import Array

HALF_HEIGHT = 0.25  # m, of the block


def x(start: float) -> Expected:
    """Return the closed form of the block's horizontal position, given its start [m]."""

    def x(p: Values, t: Array) -> Array:
        angle = radians(p["angle"])
        way = newton.incline_acceleration(angle, p["g"], p.get("mu", 0.0)) * t**2 / 2
        return newton.incline_point(start - way, HALF_HEIGHT, angle)

    return x
