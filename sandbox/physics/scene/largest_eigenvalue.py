"""The largest eigenvalue of a symmetric matrix, which need not be stored if it is large."""

from collections.abc import Callable
from typing import Any

import numpy as np

from sandbox.model.expressions import Array

LARGE = 400
"""Rows, above which one eigenvalue is sought and not all: thousands take seconds and gigabytes."""

NEARLY = 1e-4
"""The relative residual of what is sought: in a chain of 1,500 equal springs, whose eigenvalues lie
close to each other, the largest one is 7e-6 too low."""

TRIED = 40
"""Vectors that Lanczos's method keeps."""


def largest_eigenvalue(
    rows: int, matrix: Callable[[], Array], times: Callable[[Array], Array]
) -> float:
    """Return the largest eigenvalue of a positive semidefinite matrix, (rows, rows).

    `matrix` makes it, and `times` returns its product with a vector, (rows,). Infinite if values
    are not finite.
    """
    if rows <= LARGE:
        made = matrix()
        return float(np.linalg.eigvalsh(made)[-1]) if np.isfinite(made).all() else np.inf
    first = times(np.sin(1.0 + np.arange(rows)))  # not by chance: the same bits every time
    if not np.isfinite(first).all():
        return np.inf
    return _sought(rows, times, first) if first.any() else 0.0


def _sought(rows: int, times: Callable[[Array], Array], first: Array) -> float:
    """Return the largest eigenvalue by Lanczos's method from a first vector."""
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

    scale = float(np.abs(first).max())  # ARPACK squares what it is given
    operator: Any = LinearOperator((rows, rows), matvec=lambda v: times(v.ravel()), dtype=float)
    try:
        (found,) = eigsh(
            operator, 1, None, None, "LA", first / scale, TRIED, None, NEARLY,
            return_eigenvectors=False,
        )  # fmt: skip
    except ArpackNoConvergence as close:
        found = max(close.eigenvalues, default=np.inf)
    return float(found)
