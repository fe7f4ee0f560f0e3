"""The outlines of bodies, as their contacts need them."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.geometry.plane_curve import MiddleLine
from sandbox.physics.state.joint_anchors import Complexes

PARALLEL = 1e-6
"""rad, the largest angle between a side's normal and that of a contact on it."""


SHARP = 1e-7
"""m, the largest rounding of a sharp corner."""


class Figure(NamedTuple):
    """The outline of a body, as its contacts need it.

    `radius` is the outer radius of a disc, hoop or arc, and 0 of a body with sides; `inner` is the
    inner radius of a hollow body, else 0 [m]. `normals` are the unit normals of its sides,
    `corners` are the ends of these, and `center` is the centre of a disc, hoop or arc [m], all
    along its axes. `rounding` is the radius of its corners or ends [m]; `ends` tells whether it is
    an arc with ends. `middle_line` is the shape of a curve; else None.
    """

    radius: float
    normals: Complexes
    corners: Complexes
    rounding: float
    inner: float = 0.0
    center: complex = 0j
    ends: bool = False
    middle_line: MiddleLine | None = None


class Figures:
    """The outlines of n bodies, as tables.

    `radius`, `rounding`, `inner`, `center` and `ends`, (n,), are as of a `Figure`, and `corners`,
    (n, most of them), too, padded with infinity. `middle_lines` are the shapes of curves, by the
    indices of their bodies. `convex`, (n,), tells whether a body consists of discs and straight
    sides alone, seen from outside.

    `thick` tells whether any body has rounded corners or ends that are not sharp; `plain`, whether
    all round bodies are full circles about their bodies' centres; `hollow`, whether any body can be
    touched from inside.
    """

    def __init__(self, figures: list[Figure]) -> None:
        self.radius = np.array([figure.radius for figure in figures])
        self.rounding = np.array([figure.rounding for figure in figures])
        self.inner = np.array([figure.inner for figure in figures])
        self.center = np.array([figure.center for figure in figures])
        self.ends = np.array([figure.ends for figure in figures], dtype=bool)
        self.thick = bool((self.rounding > SHARP).any())
        self.hollow = bool((self.inner > 0).any())
        self.plain = not (self.center.any() or self.ends.any())
        self.convex: Booleans = ~np.array(
            [bool(f.ends or f.middle_line) for f in figures], dtype=bool
        )
        self.middle_lines = {row: f.middle_line for row, f in enumerate(figures) if f.middle_line}
        self._normals = _padded([figure.normals for figure in figures])
        self.corners = _padded([figure.corners for figure in figures])
        self._sided = np.array([len(figure.normals) > 0 for figure in figures], dtype=bool)

    def of(self, body: Integers) -> "Outlines":
        """Return the outlines of pairs of bodies: (2, k)."""
        radius, rounding = self.radius.take(body), self.rounding.take(body)
        has_corners = (radius == 0) & (rounding <= SHARP)
        return Outlines(
            self,
            body,
            np.asarray(radius > 0),
            radius,
            rounding,
            self.inner.take(body),
            self._normals.take(body, axis=0),
            np.asarray(has_corners[0] & has_corners[1]),
            bool(self._sided.take(body).any()),
        )


class Outlines(NamedTuple):
    """The outlines of the first and the second bodies at k points, fields as of `Figure`: (2, k).

    `figures` are the outlines of all bodies, and `body`, (2, k), are the indices of these bodies.
    `rounds`, (2, k), tells whether they are discs, hoops or arcs, `sharp`, (k,), whether both have
    sharp corners, and `sided` whether any has sides.
    """

    figures: Figures
    body: Integers
    rounds: Booleans
    radius: Array
    rounding: Array
    inner: Array
    normals: Complexes
    sharp: Booleans
    sided: bool

    def sides(self, direction: Complexes) -> tuple[Complexes, Array]:
        """Return the normals that are nearest to directions, along their own axes: (2, k).

        Also how far they are off, (2, k) [rad]: infinity where there are no sides.
        """
        if not self.sided:
            return direction, np.full(direction.shape, np.inf)
        off = np.abs(self.normals - direction[..., None])
        nearest = off.argmin(axis=-1)
        nearest += np.arange(0, off.size, off.shape[-1]).reshape(nearest.shape)
        return self.normals.take(nearest), off.take(nearest)

    def from_corners(self, points: Complexes) -> Array:
        """Return how far points are from the nearest corner, along their own axes: (2, k) [m]."""
        rounding = self.rounding[..., None]
        off = np.abs(self.figures.corners[self.body] - points[..., None]) - rounding
        return np.asarray(np.abs(off).min(axis=-1))

    def round(
        self, where: Complexes, rotation: Complexes, n: Complexes, middle: Complexes
    ) -> tuple[Booleans, Complexes]:
        """Return whether they are round at the contact points, and their centres: (2, k).

        `where` and `rotation`, (2, k), are the positions of the bodies, and their rotations as unit
        complex numbers; `n` and `middle`, (k,), are the normals and the contact points.
        """
        if self.figures.plain:
            return self.rounds, where
        center = where + self.figures.center[self.body] * rotation
        out = middle - center
        is_end = np.abs((n.conj() * out).imag) > PARALLEL * np.abs(out)
        return self.rounds & ~(self.figures.ends[self.body] & is_end), center

    def rolls(self, is_round: Booleans, bends: Booleans | None, within: Booleans | None) -> Array:
        """Return the radii with which they roll at the contact points: (2, k) [m]."""
        radius = self.radius if within is None else np.where(within, self.inner, self.radius)
        ends = 0.0 if bends is None else np.where(bends, self.rounding, 0.0)
        return np.where(is_round, radius, ends)


def _padded(rows: list[Complexes]) -> Complexes:
    """Return rows of different lengths, one at least, as a table padded with infinity."""
    table = np.full((len(rows), max([1, *map(len, rows)])), np.inf, dtype=complex)
    for row, known in zip(table, rows, strict=True):
        row[: len(known)] = known
    return table
