"""The functions that the tables of `static_friction.toml` name under `own`."""

from math import radians

from sandbox.model.expressions import Array, Values
from validation.formulas import newton

START = 5.0  # m, along the ramp from its foot
HALF_HEIGHT = 0.25  # m


def pulled(p: Values, t: Array) -> tuple[Array, Array]:
    """Return the distance and velocity of the block that is pulled loose [m, m/s]."""
    normal = p["mass"] * p["g"]
    return newton.pulled_loose(p["mu_s"] * normal, p["mu_k"] * normal, p["mass"], p["pull"], t)


def on_slope(p: Values, t: Array) -> Array:
    """Return the horizontal position of the block on the slope [m]."""
    angle = radians(p["angle"])
    a = newton.sticking_acceleration(angle, p["g"], p["mu_s"], p["mu_k"])
    return newton.incline_point(START - a * t**2 / 2, HALF_HEIGHT, angle)
