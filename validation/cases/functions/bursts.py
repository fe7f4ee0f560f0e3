"""The functions that the tables of `bursts.toml` name under `own`."""

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import kinematics, momentum

GIVEN = {"left": -0.8, "middle": 0.1, "right": 0.7}  # of J, across


def after(name: str, piece: str) -> Expected:
    """Return the closed form of a piece's momentum after the burst [kg m/s]."""
    return lambda p, _: p[piece] * p["vx"] + GIVEN[name] * p["J"]


def across(p: Values, t: Array) -> Array:
    """Return the horizontal position of the centre of mass [m]."""
    start = 0.25 * (p["m3"] - p["m1"]) / (p["m1"] + p["m2"] + p["m3"])
    return momentum.center_of_mass([(1.0, start, p["vx"])], t)


def up(p: Values, t: Array) -> Array:
    """Return the height of the centre of mass [m]."""
    return kinematics.uniform_position(p["vy"], -p["g"], t)
