"""Numerical solution of equations of motion without a closed form, independent of any engine."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array

RELATIVE, ABSOLUTE = 2.3e-14, 1e-15
"""The tolerances of a step: about a hundred roundings, the least that SciPy accepts."""


def solution(slope: Callable[[Array], Array], start: Array, t: ArrayLike) -> Array:
    """Return the solution of y' = slope(y) from `start` at time 0, at unordered times: (k, T).

    By SciPy's DOP853, the eighth-order method of Dormand and Prince in Hairer, Nørsett and Wanner
    (Solving Ordinary Differential Equations I, 1993). Raises `ArithmeticError` if the required step
    becomes too small.
    """
    from scipy.integrate import solve_ivp  # takes a third of a second to load

    times, places = np.unique(np.asarray(t, dtype=float), return_inverse=True)
    found = start[:, None]
    if times[-1] > 0:
        solved = solve_ivp(
            lambda _, y: slope(y), (0.0, times[-1]), start, "DOP853", times,
            rtol=RELATIVE, atol=ABSOLUTE,
        )  # fmt: skip
        if not solved.success:
            raise ArithmeticError(solved.message)
        found = solved.y
    return np.asarray(found[:, places.reshape(np.shape(t))])
