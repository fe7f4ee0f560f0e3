"""The functions that the tables of `least_action.toml` name under `own`."""

from sandbox.model.expressions import Expression
from validation.case import Expected
from validation.formulas import lagrange

ACROSS = 6.0  # m/s
LANDING = Expression("2*v/9.81")


def action(side: int, waves: int) -> Expected:
    """Return the closed form of the action of a path that deviates from the true one [J s]."""
    return lambda p, t: lagrange.action_of_throw(
        t, p["m"], (ACROSS, p["v"]), 9.81, side * p["a"], waves
    )
