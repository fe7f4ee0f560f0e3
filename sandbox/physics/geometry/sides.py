"""On which side of a line a body is: segments, arcs and curves, from their start to their end.

The side is that on which the point of the body lies that is nearest to the line. Points of the
plane are complex numbers here, along the axes of the line.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from sandbox.physics.geometry.arcs import Arc, nearest
from sandbox.physics.geometry.distance import dot
from sandbox.physics.geometry.plane_curve import Course, Foot

if TYPE_CHECKING:
    from sandbox.model.expressions import Array

LOOKS = 8
"""How often the nearest points of a body and of a line are determined in turn."""

HALVINGS = 40
"""How often an edge is bisected to find where it crosses a line."""

SAME = 1e-12
"""m, by which a repeated search may find another point and count as converged."""

TOUCHING = 1e-6
"""m, the overlap of touching bodies at which they still count as on one side."""


class Beside(NamedTuple):
    """The point of a line that is nearest to another, and the unit vector to the left there."""

    point: complex
    left: complex


class Line(Protocol):
    """What has a left and a right."""

    def beside(self, point: complex) -> Beside:
        """Return the point of it that is nearest to another [m]."""


class Straight:
    """A chain of straight pieces through two points or more [m]."""

    def __init__(self, points: Sequence[complex]) -> None:
        self._starts = np.array(points[:-1])
        self._ways = np.array([b - a for a, b in pairwise(points)])
        self._squares = np.abs(self._ways) ** 2

    def beside(self, point: complex) -> Beside:
        """Return the nearest point; in a corner, left is between the lefts of both pieces."""
        share = ((point - self._starts) * self._ways.conj()).real / self._squares
        feet = self._starts + np.clip(share, 0, 1) * self._ways
        far: Array = np.abs(feet - point)
        best = int(np.argmin(far))
        here = np.abs(feet - feet[best]) <= SAME
        way = complex((self._ways[here] / np.sqrt(self._squares[here])).sum())
        return Beside(complex(feet[best]), 1j * way / (abs(way) or 1.0))


class Round:
    """An arc, counter-clockwise about its centre."""

    def __init__(self, arc: Arc) -> None:
        self._arc = arc
        half = complex(arc.cosine, (1 - min(arc.cosine**2, 1.0)) ** 0.5)
        self._ends = [arc.middle * turn for turn in (half.conjugate(), half)]

    def beside(self, point: complex) -> Beside:
        """Return the nearest point; left is inside."""
        way = point - self._arc.center
        if not way or not self._arc.spans(way, 1 + 0j):
            way = max(self._ends, key=lambda end: dot(end, way))
        out = way / abs(way)
        return Beside(self._arc.center + self._arc.radius * out, -out)


class Curved:
    """A curve, in the direction in which its parameter runs."""

    def __init__(self, course: Course) -> None:
        self._course = course

    def beside(self, point: complex) -> Beside:
        """Return the nearest point."""
        foot = self._course.foot(point)
        feet: list[Foot] = [*self._course.ends, *([foot] if foot else [])]
        near = min(feet, key=lambda foot: abs(foot.point - point))
        return Beside(near.point, 1j * near.tangent)


def side(line: Line, core: Sequence[complex], radii: float) -> tuple[int, float]:
    """Return on which side of a line a body is, 1 to its left, −1 to its right, and how far [m].

    The side is 0 if the line goes through it, or if it lies where the line would go on.

    Parameters
    ----------
    line
        The middle of a line.
    core
        The corners of a convex body, in order, or the middle of a disc [m].
    radii
        By how much the two are thickened together [m].
    """
    middle = sum(core) / len(core)
    beside, point = min(
        (_between(line, core, start) for start in (*core, middle)),
        key=lambda found: abs(found[1] - found[0].point),
    )
    way = point - beside.point
    gap = abs(way) - radii
    edges = zip(core, (*core[1:], core[0]), strict=True) if len(core) > 1 else ()
    if abs(way) > max(radii - TOUCHING, 0.0) and not any(_crosses(line, *edge) for edge in edges):
        return int(np.sign(dot(way, beside.left))), gap
    if len(core) == 1:
        return 0, gap
    hand = 1 if dot(middle - beside.point, beside.left) > 0 else -1
    return hand if all(_is_on(line, corner, hand, radii) for corner in core) else 0, gap


def _crosses(line: Line, start: complex, end: complex) -> bool:
    """Whether a line and an edge cross."""
    low, high = _across(line, start), _across(line, end)
    if low * high > 0:
        return False
    for _ in range(HALVINGS):
        middle = (start + end) / 2
        if _across(line, middle) * low > 0:
            start = middle
        else:
            end = middle
    return abs(line.beside(start).point - start) <= SAME + abs(end - start)


def _across(line: Line, point: complex) -> float:
    """Return how far to the left of a line a point is [m]."""
    beside = line.beside(point)
    return dot(point - beside.point, beside.left)


def _is_on(line: Line, corner: complex, hand: int, radii: float) -> bool:
    """Whether a corner of a body that touches a line is on one side of it, or beyond its ends."""
    beside = line.beside(corner)
    way = corner - beside.point
    across = dot(way, beside.left)
    return hand * across > radii - TOUCHING or abs(across) < abs(way) - TOUCHING


def _between(line: Line, core: Sequence[complex], start: complex) -> tuple[Beside, complex]:
    """Return points of a line and of a body that are nearest to each other, from where one is."""
    point = start
    for _ in range(LOOKS):
        beside = line.beside(point)
        before, point = point, nearest(core, beside.point)
        if abs(point - before) <= SAME:
            break
    return beside, point
