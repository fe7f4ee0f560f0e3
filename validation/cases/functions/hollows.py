"""The functions that the tables of `hollows.toml` name under `own`."""

from math import radians

from sandbox.model.expressions import Array, Values
from validation.formulas import rotation

STARTS = {"high": (1.0, 0.0), "middle": (0.6, 0.9), "low": (0.3, 1.8)}
"""The starts of the discs: the share of the angle, and the height of the bowl over R."""


def height(disc: str, p: Values, t: Array) -> Array:
    """Return the height of a disc in a bowl [m]."""
    share, up = STARTS[disc]
    start = share * radians(p["angle"])
    return up * p["R"] + rotation.cycloid_height(rotation.DISC, p["R"], p["g"], start, t)


def pipe(p: Values) -> tuple[float, float, float]:
    """Return the radius of the path [m], gravity [m/s²], and the initial angle [rad]."""
    return p["R"] - p["r"], p["g"], radians(p["angle"])
