"""The functions that the tables of `atwood_push.toml` name under `own`."""

from sandbox.model.expressions import Values
from validation.formulas import pulleys


def acceleration(p: Values) -> float:
    """Return the acceleration of the left mass [m/s²]."""
    return pulleys.atwood_acceleration(p["m1"], p["m2"], p["g"])
