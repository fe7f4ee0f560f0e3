"""Rods, ropes, strings and pivots: sums of lengths, all of a scene in a few array operations."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.anchor import Anchor, Plane
from sandbox.physics.exact.equations import Coordinates, Rows

TINY = 1e-300


@dataclass(frozen=True, slots=True)
class Row:
    """One equation between coordinates: a sum of lengths is a given length.

    Attributes
    ----------
    joint
        The name of the joint it belongs to.
    reaches
        The pieces whose lengths add up, each between two ends.
    length
        What they add up to [m].
    changing
        What is to be added to the length at a time [m]; None if it stays.
    pulls_only
        Whether the row may also be shorter, as a rope.
    along
        A direction of the plane: its component of the one reach counts instead of its length.
    """

    joint: str
    reaches: Sequence[tuple[Anchor, Anchor]]
    length: float
    changing: Callable[[float], float] | None = None
    pulls_only: bool = False
    along: complex | None = None


class Reaches:
    """The pieces of all rows; they are the first of m rows, and the rest is left at zero.

    Parameters
    ----------
    rows
        Whose pieces they are.
    shape
        How many rows and bodies there are in all, the plane itself among these.
    inverse_moment
        (n + 1,), of the bodies and the plane [1/(kg m²)].
    turns
        Whether angles count in any case.

    Attributes
    ----------
    turns
        Whether angles count.
    """

    def __init__(
        self, rows: Sequence[Row], shape: tuple[int, int], inverse_moment: Array, *, turns: bool
    ) -> None:
        self._shape = shape
        count = shape[1]
        reaches = [(i, a, b) for i, row in enumerate(rows) for a, b in row.reaches]
        self._row = np.array([i for i, _, _ in reaches], dtype=np.intp)
        self._a, self._point_a = _ends([a for _, a, _ in reaches], count)
        self._b, self._point_b = _ends([b for _, _, b in reaches], count)
        self._offset = self._point_b - self._point_a
        self._into = np.concatenate((self._row * count + self._b, self._row * count + self._a))
        self._apart = len(np.unique(self._into)) == len(self._into)
        self._single = len(reaches) == len(rows) == shape[0]
        self._along = np.array([rows[i].along or 0j for i, _, _ in reaches], dtype=complex)
        self._component = self._along != 0
        self._has_lengths = not self._component.all()
        self._has_components = bool(self._component.any())
        levers = np.abs(self._point_a) * inverse_moment[self._a]
        levers += np.abs(self._point_b) * inverse_moment[self._b]
        bodies = np.concatenate((self._a, self._b))
        points = np.concatenate((self._point_a, self._point_b))
        # without a lever a point that is off the centre still needs the angle, once it is not 0
        self.turns = turns or bool(levers.any() or points[bodies < count - 1].any())

    def look(self, place: Coordinates) -> Rows:
        """Return what the rows add up to somewhere, and their gradients there."""
        if not len(self._row):
            turning = np.zeros(self._shape) if self.turns else None
            return Rows(np.zeros(self._shape[0]), np.zeros(self._shape, dtype=complex), turning)
        reach = place.plane[self._b] - place.plane[self._a]
        if self.turns:
            turn = np.exp(1j * place.angle)
            arm_a, arm_b = self._point_a * turn[self._a], self._point_b * turn[self._b]
            reach += arm_b - arm_a
        else:
            reach += self._offset
        length, unit = self._measure(reach)
        gradient = self._scatter(unit, -unit)
        total: Array = length
        if not self._single:
            total = np.bincount(self._row, length, self._shape[0]).astype(float)
        if not self.turns:
            return Rows(total, gradient, None)
        lever = unit.conj() * 1j
        turning = self._scatter((lever * arm_b).real, -(lever * arm_a).real)
        return Rows(total, gradient, turning)

    def _measure(self, reach: Plane) -> tuple[Array, Plane]:
        """Return the lengths or components of the pieces, and the directions they change in."""
        if not self._has_lengths:
            return (reach * self._along.conj()).real, self._along
        length = np.abs(reach)
        unit = reach / np.maximum(length, TINY)
        if self._has_components:
            unit = np.where(self._component, self._along, unit)
            length = np.where(self._component, (reach * self._along.conj()).real, length)
        return length, unit

    def _scatter(self, of_b: NDArray[Any], of_a: NDArray[Any]) -> NDArray[Any]:
        """Put what belongs to the ends of the reaches in the rows' columns of their bodies."""
        into = np.zeros(self._shape, dtype=of_b.dtype)
        both = np.concatenate((of_b, of_a))
        if self._apart:
            into.reshape(-1)[self._into] = both
        else:
            np.add.at(into.reshape(-1), self._into, both)
        return into


def _ends(anchors: Sequence[Anchor], count: int) -> tuple[NDArray[np.intp], Plane]:
    bodies = [count - 1 if anchor.body is None else anchor.body for anchor in anchors]
    return np.array(bodies, dtype=np.intp), np.array([a.point for a in anchors], dtype=complex)
