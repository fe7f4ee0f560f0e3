"""The functions that the tables of `changing_mass.toml` name under `own`."""

from sandbox.model.expressions import Array, Values
from validation.formulas import newton


def rate(p: Values) -> float:
    """Return what the rocket burns [kg/s]."""
    return p["share"] * p["mass"] / p["burn"]


def mass(p: Values, t: Array) -> Array:
    """Return what the rocket still weighs [kg]."""
    return p["mass"] - rate(p) * t


def cart(p: Values, t: Array) -> tuple[Array, Array]:
    """Return mass and velocity of the cart under the hopper [kg, m/s]."""
    force = p["drive"] * p["rate"] * p["v"]
    return newton.filling_cart(force, p["rate"], p["mass"], p["v"], t)
