"""The functions that the tables of `changing_mass.toml` name under `own`."""

from sandbox.model.expressions import Array, Values
from validation.formulas import newton


def rate(p: Values) -> float:
    """Return the rate at which the rocket burns propellant [kg/s]."""
    return p["share"] * p["mass"] / p["burn"]


def mass(p: Values, t: Array) -> Array:
    """Return the remaining mass of the rocket [kg]."""
    return p["mass"] - rate(p) * t


def cart(p: Values, t: Array) -> tuple[Array, Array]:
    """Return the mass and velocity of the cart under the hopper [kg, m/s]."""
    force = p["drive"] * p["rate"] * p["v"]
    return newton.filling_cart(force, p["rate"], p["mass"], p["v"], t)
