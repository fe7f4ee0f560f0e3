"""The functions that the tables of `belts.toml` name under `own`."""

from validation.case import Expected
from validation.formulas import newton


def caught(grains: int) -> Expected:
    """Return the momentum of a number of grains, from the rate at which they arrive."""
    return lambda p, _: newton.belt_momentum(p["v"], p["grain"] / p["every"], grains * p["every"])
