"""Many rods, ropes and pivots as a banded system, at a cost linear in their number.

Equations are coupled only if they share a body. Ordered so that coupled equations are close
together (Cuthill and McKee 1969), the matrix of a chain has three diagonals, and that of a net few
for its size. The LU factorisation of a band takes m b² operations, that of a full matrix m³.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.joints.exact.constraint_interface import MAX_ITERATIONS, QUADRATIC, Coordinates
from sandbox.physics.joints.exact.distance_equations import Reaches

FEWEST = 48
"""The smallest number of equations for which a band pays."""

NARROW = 0.2
"""The largest half bandwidth that pays, over the number of equations."""


class Linearization(NamedTuple):
    """The values of equations (m,), and the entries of their Jacobian."""

    total: Array
    partials: Array


class Banded:
    """The equations of a scene as a banded system; m equations, N bodies with the plane.

    `inverse` is the inverse mass or moment of inertia of each coordinate, (3 N,).
    """

    def __init__(self, reaches: Reaches, count: int, inverse: Array) -> None:
        self._reaches, self._count, self._inverse = reaches, count, inverse
        self._row, self._column = reaches.entries
        self._weight = inverse[self._column]
        pairs = np.array(list(self._coupled_entries()), dtype=np.intp).reshape(-1, 2)
        self._there, self._here = pairs.T
        rows, columns = self._row[self._there], self._row[self._here]
        self._order = _close_together(rows, columns, count)
        rank = np.empty(count, dtype=np.intp)
        rank[self._order] = np.arange(count)
        i, j = rank[rows], rank[columns]
        self.width = int(np.abs(i - j).max(initial=0))
        self._into = (2 * self.width + i - j) * count + j  # as LAPACK keeps a band
        self._size = (3 * self.width + 1) * count

    def _coupled_entries(self) -> Iterator[tuple[int, int]]:
        """Yield the pairs of entries of the same coordinate, for coordinates that can change."""
        held: dict[int, list[int]] = {}
        for entry in np.flatnonzero(self._weight).tolist():
            held.setdefault(int(self._column[entry]), []).append(entry)
        for entries in held.values():
            yield from ((a, b) for a in entries for b in entries)

    @property
    def is_cheaper(self) -> bool:
        """Whether the band is cheaper than the full matrix."""
        return self._count >= FEWEST and self.width <= NARROW * self._count

    def linearize(self, pose: Coordinates) -> Linearization:
        """Return the values of the equations at given positions, and their Jacobian."""
        return Linearization(*self._reaches.measure(pose))

    def rates(self, linear: Linearization, motion: Array) -> Array:
        """Return the rates J v of the equations at velocities v (3 N,): (m,)."""
        velocity = linear.partials * motion[self._column]
        return np.bincount(self._row, velocity, self._count).astype(float, copy=False)

    def response(self, linear: Linearization, impulse: Array) -> Array:
        """Return the velocity changes M⁻¹ Jᵀ λ by impulses λ (m,): (3 N,)."""
        push = impulse[self._row] * linear.partials * self._weight
        return np.bincount(self._column, push, len(self._inverse)).astype(float, copy=False)

    def solved(self, there: Linearization, here: Linearization, violation: Array) -> Array:
        """Return the impulses along the Jacobian `here` that change the values `there`: (m,).

        The violation, (m,), is the change. Raises `LinAlgError` if the matrix is singular.
        """
        from scipy.linalg.lapack import dgbsv  # slow to import, and few scenes need it

        products = there.partials[self._there] * (self._weight * here.partials)[self._here]
        band = np.bincount(self._into, products, self._size).reshape(-1, self._count)
        *_, found, failed = dgbsv(self.width, self.width, band, violation[self._order])
        if failed:
            raise np.linalg.LinAlgError
        impulse = np.empty_like(violation)
        impulse[self._order] = found
        return impulse

    def hold(
        self,
        pose: Coordinates,
        motion: Coordinates,
        here: Linearization,
        length: Array,
        guess: Array,
        drift: float,
    ) -> tuple[Array, Array, Array]:
        """Return the impulses that keep lengths through a drift, by Newton's method.

        The impulses, (m,), come with the velocities after them, (3 N,), and the residuals of the
        last iteration, (m,), which exceed rounding if there is no solution. Position, motion and
        equations are those at the beginning of the drift [s]; `length` are the lengths to keep,
        (m,) [m], and `guess` is the initial guess of the impulses, (m,) [N s].
        """
        impulse = guess
        for _ in range(MAX_ITERATIONS):
            velocity = motion.values - self.response(here, impulse)
            there = self.linearize(Coordinates(pose.values + drift * velocity))
            wrong = there.total - length
            impulse = impulse + self.solved(there, here, wrong) / drift
            if wrong.dot(wrong) <= QUADRATIC**2:
                break
        return impulse, motion.values - self.response(here, impulse), wrong


def _close_together(rows: Integers, columns: Integers, count: int) -> Integers:
    """Return an order of the equations that brings coupled ones, given in pairs, close together."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    meet = csr_array((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    return np.asarray(reverse_cuthill_mckee(meet, symmetric_mode=True), dtype=np.intp)
