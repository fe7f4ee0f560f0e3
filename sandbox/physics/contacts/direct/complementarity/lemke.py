"""Lemke's method for linear complementarity problems.

    w = M z + q,    w >= 0,  z >= 0,  wᵀ z = 0

It moves along vertices that satisfy all conditions but one, and reaches a solution whenever a
contact problem has one: their matrices are copositive (Stewart and Trinkle
1996; R. W. Cottle, J.-S. Pang, R. E. Stone: The Linear Complementarity Problem, chapter 4.4). It is
slower than updates of the active set, and used only where these cycle.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.redundant_systems import max_abs
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.state.cancellation_points import cancellation_point

PIVOTS = 20
"""The most pivots per condition."""

WORK = 4e9
"""The most changes of entries of the tableau: some seconds of computing."""

NOTHING = 1e-11
"""Entries below this share of the largest in their column cannot be pivots."""

TIE = 1e-12
"""Ratios that differ by less than this share of the largest are tied; the largest pivot wins."""

GONE = 1e-13
"""The artificial variable counts as 0 below this share of its first value: then all conditions hold
even if it is still in the basis."""

NEARLY = 1e-9
"""The same if no row limits the next variable: rounding then decides whether the row of the
artificial variable does. The caller checks the conditions."""


def lemke(matrix: Array, offset: Array) -> Array | None:
    """Return z, (n,), for M, (n, n), and q, (n,), as above; None if none is found."""
    count = len(offset)
    if not count or offset.min() >= 0:
        return np.zeros(count)
    cover = 1 + 0.5 * np.cos(np.arange(1.0, count + 1) ** 2)  # no two alike: ties are rare
    table = np.column_stack((-matrix, -cover, offset))
    basis = np.arange(count)
    artificial = 2 * count
    column_of = np.arange(-count, count + 1)  # for variables not in the basis
    entering, row = artificial, int(np.argmin(offset / cover))
    its_row, first_value = row, float((-offset / cover).max())
    for _ in range(min(PIVOTS * count, int(WORK / count**2))):
        cancellation_point()
        leaving = int(basis[row])
        _pivot(table, row, int(column_of[entering]))
        basis[row], column_of[leaving] = entering, column_of[entering]
        if leaving == artificial or table[its_row, -1] <= GONE * first_value:
            return _read(table, basis, count)
        entering = leaving + count if leaving < count else leaving - count
        found = _ratio(table, int(column_of[entering]), basis, artificial)
        if found is None:
            nearly = table[its_row, -1] <= NEARLY * first_value
            return _read(table, basis, count) if nearly else None
        row = found
    return None


def _pivot(table: Array, row: int, column: int) -> None:
    """Exchange the variables of a row and a column.

    The columns of basic variables are unit vectors, and are not stored. BLAS changes the table in
    place, in a seventh of the time that NumPy takes for it.
    """
    from scipy.linalg.blas import dger  # a tenth of a second, for those who need it

    factor = table[:, column].copy()
    table[:, column], table[row, column] = 0.0, 1.0
    table[row] /= factor[row]
    factor[row] = 0.0
    dger(-1.0, table[row].copy(), factor, a=table.T, overwrite_a=1)


def _ratio(table: Array, entering: int, basis: Integers, artificial: int) -> int | None:
    """Return the row whose variable a column's variable drives to zero first.

    None if there is no such row, or if the numbers overflow.
    """
    column, value = table[:, entering], np.maximum(table[:, -1], 0.0)
    some = (column > NOTHING * max_abs(column)).nonzero()[0]
    if not len(some):
        return None
    column, tie = column.take(some), TIE * value[value.argmax()]
    ratio = value.take(some) / column
    least = (ratio + tie / column).min()
    if not np.isfinite(least):
        return None
    tied = (ratio <= least).nonzero()[0]
    rows = some[tied]
    first = (basis[rows] == artificial).nonzero()[0]
    return int(rows[first[0] if len(first) else column[tied].argmax()])


def _read(table: Array, basis: Integers, count: int) -> Array:
    found = np.zeros(2 * count + 1)
    found[basis] = np.maximum(table[:, -1], 0.0)
    return found[count : 2 * count]
