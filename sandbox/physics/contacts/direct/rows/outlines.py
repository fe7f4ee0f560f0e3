"""The outlines of bodies, as their contacts need them."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Booleans, Integers
from sandbox.physics.geometry.plane_curve import Course
from sandbox.physics.state.anchor import Plane

PARALLEL = 1e-6
"""rad, the largest angle between a side's normal and that of a contact on it."""


SHARP = 1e-7
"""m, the largest rounding of a sharp corner."""


class Figure(NamedTuple):
    """The outline of a body, as its contacts need it.

    Attributes
    ----------
    radius
        The outer radius of a disc, hoop or arc; 0 of a body with sides [m].
    normals
        The unit normals of its sides, along its axes.
    rounding
        The radius of its corners or ends [m].
    inner
        The inner radius of a hollow body; else 0 [m].
    center
        The centre of a disc, hoop or arc, along its axes [m].
    ends
        Whether it is an arc with ends.
    course
        The shape of a curve; else None.
    """

    radius: float
    normals: Plane
    rounding: float
    inner: float = 0.0
    center: complex = 0j
    ends: bool = False
    course: Course | None = None


class Figures:
    """The outlines of n bodies, as tables.

    Attributes
    ----------
    radius, rounding, inner, center
        (n,) each, as of a `Figure` [m].
    ends
        (n,), whether it is an arc with ends.
    courses
        The shapes of curves, by the indices of their bodies.
    thick
        Whether any body has rounded corners or ends that are not sharp.
    plain
        Whether all round bodies are full circles about their bodies' centres.
    hollow
        Whether any body can be touched from inside.
    convex
        (n,), whether a body consists of discs and straight sides alone, seen from outside.
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
        self.convex: Booleans = ~np.array([bool(f.ends or f.course) for f in figures], dtype=bool)
        self.courses = {row: f.course for row, f in enumerate(figures) if f.course}
        most = max((len(figure.normals) for figure in figures), default=0)
        self._normals = np.full((len(figures), max(most, 1)), np.nan, dtype=complex)
        for row, figure in enumerate(figures):
            self._normals[row, : len(figure.normals)] = figure.normals
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

    Attributes
    ----------
    figures
        The outlines of all bodies.
    body
        (2, k), the indices of the bodies.
    rounds
        (2, k), whether they are discs, hoops or arcs.
    sharp
        (k,), whether both have sharp corners.
    sided
        Whether any has sides.
    """

    figures: Figures
    body: Integers
    rounds: Booleans
    radius: Array
    rounding: Array
    inner: Array
    normals: Plane
    sharp: Booleans
    sided: bool

    def faces(self, direction: Plane) -> Booleans:
        """Return whether they have a side with this normal, along their own axes: (2, k)."""
        if not self.sided:
            return np.zeros(direction.shape, dtype=bool)
        off = np.abs(self.normals - direction[..., None])
        return np.asarray((off < PARALLEL).any(axis=-1))

    def round(self, where: Plane, turned: Plane, n: Plane, middle: Plane) -> tuple[Booleans, Plane]:
        """Return whether they are round at the contact points, and their centres: (2, k).

        Parameters
        ----------
        where, turned
            The positions of the bodies, and their rotations as unit complex numbers, (2, k) each.
        n, middle
            The normals and the contact points, (k,) each.
        """
        if self.figures.plain:
            return self.rounds, where
        center = where + self.figures.center[self.body] * turned
        out = middle - center
        is_end = np.abs((n.conj() * out).imag) > PARALLEL * np.abs(out)
        return self.rounds & ~(self.figures.ends[self.body] & is_end), center

    def rolls(self, is_round: Booleans, bends: Booleans | None, within: Booleans | None) -> Array:
        """Return the radii with which they roll at the contact points: (2, k) [m]."""
        radius = self.radius if within is None else np.where(within, self.inner, self.radius)
        ends = 0.0 if bends is None else np.where(bends, self.rounding, 0.0)
        return np.where(is_round, radius, ends)
