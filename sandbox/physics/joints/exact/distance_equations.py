"""Rods, ropes, strings and pivots: sums of lengths, computed together for a whole scene."""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.constraint_interface import Change, Coordinates, Rows
from sandbox.physics.state.joint_anchors import Anchor, Complexes

TINY = 1e-300


@dataclass(frozen=True, slots=True)
class Row:
    """One equation: a sum of lengths is kept."""

    joint: str
    reaches: Sequence[tuple[Anchor, Anchor]]
    """The segments whose lengths are added, each between two ends."""
    length: float
    """The sum to keep [m]."""
    changing: Change | None = None
    """The change of that sum in time; None if it is constant."""
    pulls_only: bool = False
    """Whether the sum is an upper bound, as for a rope."""
    along: complex | None = None
    """A unit direction: the component of the single segment along it counts, not its length."""


class Reaches:
    """The segments of all sums of lengths: the first of m rows; the other rows are left at zero.

    The shape has the numbers of all rows and of all bodies with the plane itself; `inverse_moment`,
    (n + 1,), their inverse moments of inertia [1/(kg m²)]. If it `turns`, the Jacobian has angles
    even if no segment needs them.
    """

    def __init__(
        self, rows: Sequence[Row], shape: tuple[int, int], inverse_moment: Array, *, turns: bool
    ) -> None:
        count = shape[1]
        self._shape = shape[0], 3 * count
        reaches = [(i, a, b) for i, row in enumerate(rows) for a, b in row.reaches]
        self._row = np.array([i for i, _, _ in reaches], dtype=np.intp)
        self._half = len(reaches)
        held = [a for _, a, _ in reaches] + [b for _, _, b in reaches]
        self._body, points = _ends(held, count)
        self.set_points(points)
        self._single = self._half == len(rows) == shape[0]
        self._along = np.array([rows[i].along or 0j for i, _, _ in reaches], dtype=complex)
        self._across = self._along.conj()
        self._component = self._along != 0
        self._has_lengths = not self._component.all()
        self._has_components = bool(self._component.any())
        levers = np.abs(self._point) * inverse_moment[self._body]
        # a point off the centre of a body that cannot turn still needs that body's angle
        off = self._point[self._body < count - 1].any()
        self._turns = turns or bool(levers.any() or off)
        self._into = self._places(3 * count, count)
        self._apart = len(np.unique(self._into)) == len(self._into)

    def _places(self, width: int, count: int) -> NDArray[np.intp]:
        """Return the flat indices of the ends in the Jacobian: x and y of each, then angles."""
        start = np.tile(self._row, 2) * width
        plane = np.stack((start + 2 * self._body, start + 2 * self._body + 1), axis=1).ravel()
        return np.concatenate((plane, start + 2 * count + self._body)) if self._turns else plane

    @property
    def entries(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The row and coordinate of each partial derivative of `measure`; some pairs repeat."""
        row, column = np.divmod(self._into, self._shape[1])
        return row, column

    def evaluate(self, pose: Coordinates) -> Rows:
        """Return the values of the rows at given positions, and their Jacobian.

        Positions may have leading axes, such as one of many runs.
        """
        many = pose.values.shape[:-1]
        jacobian = np.zeros((*many, *self._shape))
        if not self._half:
            return Rows(np.zeros((*many, self._shape[0])), jacobian)
        total, partials = self.measure(pose)
        self._spread(partials, jacobian.reshape(*many, -1))
        return Rows(total, jacobian)

    def write_negative(self, pose: Coordinates, total: Array, jacobian: Array) -> None:
        """Write the negative of what `evaluate` returns, at positions without leading axes."""
        if self._apart and self._half:
            length, partials = self.measure(pose)
            jacobian.fill(-0.0)
            jacobian.reshape(-1)[self._into] = -partials
        else:
            length, jacobian[:] = self.evaluate(pose)
            np.negative(jacobian, out=jacobian)
        np.negative(length, out=total)

    def measure(self, pose: Coordinates) -> tuple[Array, Array]:
        """Return the values of the rows at given positions, and the entries of their Jacobian."""
        ends = pose.position.take(self._body, axis=-1)
        if self._turns:
            arm = self._point * pose.rotation.take(self._body, axis=-1)
            ends += arm
            length, unit = self._measure(ends[..., self._half :] - ends[..., : self._half])
            both = np.concatenate((-unit, unit), axis=-1)
            partials = np.concatenate((both.view(float), -(both.conj() * arm).imag), axis=-1)
        else:
            reach = ends[..., self._half :] - ends[..., : self._half]
            length, unit = self._measure(reach + self._offset)
            partials = np.concatenate((-unit, unit), axis=-1).view(float)
        return self._row_sums(length), partials

    @property
    def points(self) -> Complexes:
        """The anchor points on the bodies, first all beginnings, then all ends [m]."""
        return self._point

    def with_points(self, points: Complexes) -> "Reaches":
        """Return the same segments with other anchor points: (N, 2 k) for many runs."""
        found = copy(self)
        found.set_points(points)
        return found

    def set_points(self, points: Complexes) -> None:
        """Set the anchor points on the bodies."""
        self._point = points
        self._offset = points[..., self._half :] - points[..., : self._half]

    def _spread(self, partials: Array, jacobian: Array) -> None:
        """Add the partial derivatives by the ends to the flat Jacobian."""
        if self._apart and jacobian.ndim == 1:  # in a fifth of the time of `...`
            jacobian[self._into] = partials
        elif self._apart:
            jacobian[..., self._into] = partials
        else:
            where: Any = (..., self._into)
            np.add.at(jacobian, where, partials)

    def _row_sums(self, length: Array) -> Array:
        """Return the sum of the lengths of each row."""
        if self._single:
            return length
        total = np.zeros((*length.shape[:-1], self._shape[0]))
        where: Any = (..., self._row)
        np.add.at(total, where, length)
        return total

    def _measure(self, reach: Complexes) -> tuple[Array, Complexes]:
        """Return the lengths or components of the segments, and their gradients."""
        if not self._has_lengths:
            return (reach * self._across).real, self._along
        length = np.abs(reach)
        unit = reach / np.maximum(length, TINY)
        if self._has_components:
            unit = np.where(self._component, self._along, unit)
            length = np.where(self._component, (reach * self._across).real, length)
        return length, unit


def _ends(anchors: Sequence[Anchor], count: int) -> tuple[NDArray[np.intp], Complexes]:
    bodies = [count - 1 if anchor.body is None else anchor.body for anchor in anchors]
    return np.array(bodies, dtype=np.intp), np.array([a.point for a in anchors], dtype=complex)
