"""Linear systems with redundant rows."""

from functools import cache
from importlib import import_module
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.dense_systems import solve
from sandbox.physics.state.cancellation_points import cancellation_point

REPEATS = 1e11
"""The largest ratio of solution to right-hand side that counts as regular; beyond it rows are
redundant. A mass of 1,000,000 on one of 1 has 1e7, one of 31,000,000 on 31 boxes 1e10."""

CUT = 1e-10
"""The relative cutoff for the rank of a matrix with redundant rows."""

SOUND = 1e6
"""The largest ratio of solution to right-hand side, times the largest diagonal element, at which
elimination is as accurate as singular values."""

FEASIBLE = 1e-12
"""Limits contradict each other if the residual is below this: that is rounding."""


def preload() -> None:
    """Import what redundant rows need; within a step that would take up to half a second."""
    for library in ("scipy.linalg.lapack", "scipy.linalg.blas", "scipy.optimize"):
        import_module(library)


def max_abs(values: Array) -> float:
    """Return the largest absolute value; 0 of an empty array, NaN if any value is NaN."""
    sizes = np.abs(values)
    return sizes.item(sizes.argmax()) if len(sizes) else 0.0


def solved(matrix: Array, rhs: Array) -> tuple[Array, bool]:
    """Return the solution of a linear system, and whether its rows are redundant.

    With redundant rows it is the smallest least-squares solution: before Newton's method has
    converged, such rows contradict each other a little.
    """
    if len(rhs) == 1:
        return rhs / (matrix[0] if matrix[0, 0] else 1.0), False
    try:
        found, probe = solve(matrix, np.array((rhs, _probe(len(rhs)))).T).T
    except np.linalg.LinAlgError:
        probe = found = np.full(1, np.inf)
    if max_abs(probe) < REPEATS:
        return np.asarray(found), False
    least = _minimum_norm(matrix, rhs)
    return least + _minimum_norm(matrix, rhs - matrix @ least), True


def _minimum_norm(matrix: Array, rhs: Array) -> Array:
    """Return the smallest least-squares solution, by a complete orthogonal decomposition.

    LAPACK is called directly: on few rows the checks of SciPy's `lstsq` take longer than its work.
    """
    from scipy.linalg.lapack import dgelsy  # a tenth of a second, for those who need it

    cancellation_point()
    count = len(matrix)
    _, found, *_ = dgelsy(matrix, rhs, np.zeros(count, np.int32), CUT, _room(count).least)
    return np.asarray(found[:, 0] if found.ndim > 1 else found)


def nearest(matrix: Array, rhs: Array) -> Array:
    """Return the smallest least-squares solution of a symmetric system: (m,) or (m, s).

    By elimination where its rows are clearly independent, else by singular values.
    """
    count = len(matrix)
    if count == 1:
        return rhs / matrix[0, 0] if matrix[0, 0] else 0.0 * rhs
    columns = np.column_stack((_probe(count), rhs))
    try:
        found = solve(matrix, columns)
        if max_abs(found[:, 0]) * matrix.diagonal().max() < SOUND:
            return np.asarray(found[:, 1:].reshape(rhs.shape))
    except np.linalg.LinAlgError:
        pass
    return np.asarray(np.linalg.lstsq(matrix, rhs, rcond=CUT)[0])


def null(matrix: Array) -> Array:
    """Return an orthonormal basis of the null space of a square matrix, as columns: (m, l)."""
    from scipy.linalg.lapack import dgeqp3, dorgqr

    cancellation_point()
    room = _room(len(matrix))
    triangle, _, reflections, *_ = dgeqp3(matrix.T, lwork=room.triangle)
    size = np.abs(triangle.diagonal())
    across = dorgqr(triangle, reflections, lwork=room.across)[0]
    return np.asarray(across[:, int((size > CUT * size[0]).sum()) :])


class _Room(NamedTuple):
    """The sizes of LAPACK's work arrays for square matrices of one size."""

    least: int
    triangle: int
    across: int


@cache
def _room(count: int) -> _Room:
    """Ask LAPACK for the sizes of its work arrays."""
    from scipy.linalg.lapack import dgelsy_lwork, dgeqp3, dorgqr

    matrix, column = np.eye(count), np.zeros(count)
    least, _ = dgelsy_lwork(count, count, 1, CUT)
    triangle = dgeqp3(matrix, lwork=-1)[3][0]
    across = dorgqr(matrix, column, lwork=-1)[1][0]
    return _Room(int(least), int(triangle), int(across))


def least_distance(limits: Array, least: Array) -> Array | None:
    """Return the shortest vector z with limits @ z >= least; None if there is none.

    By non-negative least squares (C. L. Lawson, R. J. Hanson: Solving Least Squares Problems, 1974,
    chapter 23).
    """
    from scipy.optimize import nnls

    if not limits.shape[1]:
        return None
    if not len(limits):  # SciPy 1.17 frees memory twice at a table of no columns
        return np.zeros(limits.shape[1])
    size = np.abs(least).max(initial=0.0) or 1.0
    rhs = np.zeros(limits.shape[1] + 1)
    rhs[-1] = 1.0
    table = np.vstack((limits.T, least / size))
    try:
        weights, _ = nnls(table, rhs)
    except RuntimeError:  # it has gone on for too long
        return None
    off = table @ weights - rhs
    return None if -off[-1] < FEASIBLE else -off[:-1] / off[-1] * size


@cache
def _probe(count: int) -> Array:
    """Return a vector in no particular direction, whose image shows the size of the inverse."""
    return np.cos(np.arange(1.0, count + 1) ** 2)
