"""Equations of motion without a closed form, integrated apart from any engine."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas.arrays import Array

STEP = 1e-3
"""The longest step; its error is of fourth order."""


def solution(slope: Callable[[Array], Array], start: Array, t: ArrayLike) -> Array:
    """Return what y' = slope(y) leads to at rising times: (k, T), from start at time 0.

    The classical method of Runge and Kutta (1901), in steps no longer than `STEP` of the unit that
    the times have: choose it so that nothing changes much in a hundredth of it.
    """
    times = np.atleast_1d(np.asarray(t, dtype=float))
    y, now = start, 0.0
    found = np.empty((len(start), len(times)))
    for i, then in enumerate(times):
        steps = max(int(np.ceil((then - now) / STEP)), 1)
        h = (then - now) / steps
        for _ in range(steps):
            a = slope(y)
            b = slope(y + h / 2 * a)
            c = slope(y + h / 2 * b)
            d = slope(y + h * c)
            y = y + h / 6 * (a + 2 * b + 2 * c + d)
        found[:, i], now = y, float(then)
    return found if np.ndim(t) else found[:, 0]
