"""The outlines of bodies, in the form that their contacts need."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Booleans, Integers
from sandbox.physics.geometry.plane_curve import Course
from sandbox.physics.state.anchor import Plane

PARALLEL = 1e-6
"""rad, by which a side and a contact may differ in direction and the contact be on that side."""


SHARP = 1e-7
"""m, a corner that is rounded by no more than this is one."""


class Figure(NamedTuple):
    """What the outline of a body is to its contacts.

    Attributes
    ----------
    radius
        Of what is round, where it is touched from outside; 0 of what has sides [m].
    normals
        The unit normals of its sides, along its axes.
    rounding
        The radius of its corners, or ends [m].
    inner
        Of what is hollow, where it is touched from inside [m].
    center
        Of what is round, along its axes [m].
    ends
        Whether what is round is not so all the way.
    course
        Of what is a curve, or None.
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
        (n,), whether it is round, but not all the way.
    courses
        Of those that are curves, by their numbers.
    plain
        Whether what is round is so all the way, about its body's centre.
    hollow
        Whether anything can be touched from inside.
    straight
        (n,), which are made of discs and straight sides alone.
    """

    def __init__(self, figures: list[Figure]) -> None:
        self.radius = np.array([figure.radius for figure in figures])
        self.rounding = np.array([figure.rounding for figure in figures])
        self.inner = np.array([figure.inner for figure in figures])
        self.center = np.array([figure.center for figure in figures])
        self.ends = np.array([figure.ends for figure in figures], dtype=bool)
        self.hollow = bool((self.inner > 0).any())
        self.plain = not (self.center.any() or self.ends.any())
        bent = [bool(f.inner > 0 or f.ends or f.course) for f in figures]
        self.straight: Booleans = ~np.array(bent, dtype=bool)
        self.courses = {row: f.course for row, f in enumerate(figures) if f.course}
        most = max((len(figure.normals) for figure in figures), default=0)
        self._normals = np.full((len(figures), max(most, 1)), np.nan, dtype=complex)
        for row, figure in enumerate(figures):
            self._normals[row, : len(figure.normals)] = figure.normals
        self._sided = np.array([len(figure.normals) > 0 for figure in figures], dtype=bool)

    def of(self, body: Integers) -> "Outlines":
        """Return those of two bodies each: (2, k)."""
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
    """The outlines of the first and the second bodies at k points, as of a `Figure` each: (2, k).

    Attributes
    ----------
    figures
        Of all bodies.
    body
        (2, k), which.
    rounds
        (2, k), whether they are round, if not all the way.
    sharp
        (k,), whether both have corners.
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
        """Return whether they have a side that faces there, along their own axes: (2, k)."""
        if not self.sided:
            return np.zeros(direction.shape, dtype=bool)
        off = np.abs(self.normals - direction[..., None])
        return np.asarray((off < PARALLEL).any(axis=-1))

    def round(self, where: Plane, turned: Plane, n: Plane, middle: Plane) -> tuple[Booleans, Plane]:
        """Return whether they are round where they touch, and where their centres are: (2, k).

        Parameters
        ----------
        where, turned
            Where the bodies are, and how they are turned, (2, k) each.
        n, middle
            The normals, and where they touch, (k,) each.
        """
        if self.figures.plain:
            return self.rounds, where
        center = where + self.figures.center[self.body] * turned
        out = middle - center
        is_end = np.abs((n.conj() * out).imag) > PARALLEL * np.abs(out)
        return self.rounds & ~(self.figures.ends[self.body] & is_end), center

    def rolls(self, is_round: Booleans, corner: Booleans, within: Booleans | None) -> Array:
        """Return the radii with which they roll where they touch: (2, k) [m]."""
        radius = self.radius if within is None else np.where(within, self.inner, self.radius)
        return np.where(is_round, radius, np.where(corner, self.rounding, 0.0))
