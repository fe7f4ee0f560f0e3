"""The functions that the tables of `beads.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.formulas import energy, lagrange

ROUND = 0.85
"""The sharpness of the zigzag's corners: 1 for perfectly sharp ones."""


def race(bead: str, p: Values, _: Array) -> float:
    """Return the time to the bottom [s]; the straight wire's slope is 2 over π."""
    if bead == "cycloid":
        return lagrange.cycloid_time(p["R"], p["g"])
    return energy.time_of_descent(
        lambda s: np.pi * p["R"] * s, lambda s: 2 * p["R"] * (1 - s), p["g"]
    )


def descent(level: str, p: Values, _: Array) -> float:
    """Return the time to the bottom of a slide [s]."""
    h = p["height"]
    if level == "curved-ramp":
        return energy.time_of_descent(
            lambda s: p["width"] * (s - 1), lambda s: h * (1 - s) ** 2, p["g"]
        )
    if level == "zigzag":
        return energy.time_of_descent(
            lambda s: h / 4 * np.arcsin(ROUND * np.sin(3 * np.pi * s)) / np.arcsin(ROUND),
            lambda s: h * (1 - s),
            p["g"],
        )
    return energy.time_of_descent(
        lambda s: h / 5 * np.sin(4 * np.pi * s), lambda s: h * (1 - s), p["g"]
    )


def cycloid_height(share: float, p: Values, t: Array) -> Array:
    """Return the height of a bead that starts at a share of the angle [m]."""
    start = share * np.radians(p["angle"])
    return lagrange.cycloid_height(t, p["R"], p["g"], float(start))
