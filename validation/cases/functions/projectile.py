"""The functions that the tables of `projectile.toml` name under `own`."""

from math import radians

from sandbox.model.expressions import Values
from validation.formulas import kinematics


def flight_time(p: Values) -> float:
    """Return the time of flight from a height [s]."""
    return kinematics.flight_time(p["speed"], radians(p["angle"]), p["g"], p["height"])
