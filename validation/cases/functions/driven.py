"""The functions that the tables of `driven.toml` name under `own`."""

from collections.abc import Callable
from math import sqrt

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import lagrange

MASS = 1.0  # kg
Swing = Callable[[Array, float, float, float, float, float], Array]


def driven(swing: Swing) -> Expected:
    """Return the closed form of a driven spring's displacement, from one of the chapter's [m]."""

    def expected(p: Values, t: Array) -> Array:
        drive = p["ratio"] * sqrt(p["k"] / MASS)
        return swing(t, MASS, p["k"], p["c"], p["F"], drive)

    return expected


def in_row(ratio: float) -> Expected:
    """Return the closed form of a spring in the row, for the frequency ratio of its drive [m]."""

    def expected(p: Values, t: Array) -> Array:
        drive = ratio * sqrt(p["k"] / MASS)
        return np.asarray(lagrange.driven_oscillation(t, MASS, p["k"], p["c"], p["F"], drive))

    return expected
