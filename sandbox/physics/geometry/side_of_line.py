"""The side of a line on which a body is; lines are segments, arcs and curves from start to end.

It is the side of the body's point that is nearest to the line. Points of the plane are complex
numbers here, in the axes of the line.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from sandbox.physics.geometry.arc_contacts import Arc, nearest
from sandbox.physics.geometry.outline_distance import dot, mean
from sandbox.physics.geometry.plane_curve import CurvePoint, MiddleLine

if TYPE_CHECKING:
    from sandbox.model.expressions import Array

LOOKS = 8
"""The most alternating projections onto a line and a body to find their nearest points."""

HALVINGS = 40
"""The number of bisections of an edge to find where it crosses a line."""

SAME = 1e-12
"""m, the distance below which two points count as the same."""

TOUCHING = 1e-6
"""m, the largest overlap of touching bodies that still count as on one side."""


class NearestPoint(NamedTuple):
    """The point of a line that is nearest to another, and the unit vector to the left there."""

    point: complex
    left: complex


class Line(Protocol):
    """A line with a left and a right side."""

    def nearest(self, point: complex) -> NearestPoint:
        """Return its point nearest to another point [m]."""


class Straight:
    """A chain of straight segments through two or more points [m]."""

    def __init__(self, points: Sequence[complex]) -> None:
        self._starts = np.array(points[:-1])
        self._segments = np.array([b - a for a, b in pairwise(points)])
        self._squares = np.abs(self._segments) ** 2

    def nearest(self, point: complex) -> NearestPoint:
        """Return the nearest point; at a corner, left bisects the lefts of both segments."""
        fraction = ((point - self._starts) * self._segments.conj()).real / self._squares
        feet = self._starts + np.clip(fraction, 0, 1) * self._segments
        distances: Array = np.abs(feet - point)
        best = int(np.argmin(distances))
        at_best = np.abs(feet - feet[best]) <= SAME
        direction = complex((self._segments[at_best] / np.sqrt(self._squares[at_best])).sum())
        return NearestPoint(complex(feet[best]), 1j * direction / (abs(direction) or 1.0))


class Round:
    """An arc, counter-clockwise about its centre."""

    def __init__(self, arc: Arc) -> None:
        self._arc = arc
        half = complex(arc.cosine, (1 - min(arc.cosine**2, 1.0)) ** 0.5)
        self._ends = [arc.middle * turn for turn in (half.conjugate(), half)]

    def nearest(self, point: complex) -> NearestPoint:
        """Return the nearest point; left is inside."""
        offset = point - self._arc.center
        if not offset or not self._arc.spans(offset, 1 + 0j):
            offset = max(self._ends, key=lambda end: dot(end, offset))
        outward = offset / abs(offset)
        return NearestPoint(self._arc.center + self._arc.radius * outward, -outward)


class Curved:
    """A curve, in the direction of its increasing parameter."""

    def __init__(self, middle_line: MiddleLine) -> None:
        self._middle_line = middle_line

    def nearest(self, point: complex) -> NearestPoint:
        """Return the nearest point."""
        foot = self._middle_line.foot_point(point)
        feet: list[CurvePoint] = [*self._middle_line.ends, *([foot] if foot else [])]
        best = min(feet, key=lambda foot: abs(foot.point - point))
        return NearestPoint(best.point, 1j * best.tangent)


def side(line: Line, core: Sequence[complex], radii: float) -> tuple[int, float]:
    """Return the side of a line on which a body is, 1 left and −1 right, and the gap [m].

    The side is 0 if the line passes through the body, or if the body is straight ahead of its end.
    `core` has the corners of a convex body, in order, or the centre of a disc [m]; `radii` is the
    sum of the radii around line and core [m].
    """
    middle = mean(core)
    nearest_point, point = min(
        (_nearest_points(line, core, start) for start in (*core, middle)),
        key=lambda found: abs(found[1] - found[0].point),
    )
    offset = point - nearest_point.point
    gap = abs(offset) - radii
    edges = zip(core, (*core[1:], core[0]), strict=True) if len(core) > 1 else ()
    if abs(offset) > max(radii - TOUCHING, 0.0) and not any(
        _crosses(line, *edge) for edge in edges
    ):
        return int(np.sign(dot(offset, nearest_point.left))), gap
    if len(core) == 1:
        return 0, gap
    sign = 1 if dot(middle - nearest_point.point, nearest_point.left) > 0 else -1
    return sign if all(_is_on(line, corner, sign, radii) for corner in core) else 0, gap


def _crosses(line: Line, start: complex, end: complex) -> bool:
    """Return whether a line and an edge cross."""
    low, high = _signed_distance(line, start), _signed_distance(line, end)
    if low * high > 0:
        return False
    for _ in range(HALVINGS):
        middle = (start + end) / 2
        if _signed_distance(line, middle) * low > 0:
            start = middle
        else:
            end = middle
    return abs(line.nearest(start).point - start) <= SAME + abs(end - start)


def _signed_distance(line: Line, point: complex) -> float:
    """Return the distance of a point to the left of a line [m]."""
    nearest_point = line.nearest(point)
    return dot(point - nearest_point.point, nearest_point.left)


def _is_on(line: Line, corner: complex, sign: int, radii: float) -> bool:
    """Return whether a corner of a touching body is on one side of a line, or beyond its ends."""
    nearest_point = line.nearest(corner)
    offset = corner - nearest_point.point
    distance = dot(offset, nearest_point.left)
    return sign * distance > radii - TOUCHING or abs(distance) < abs(offset) - TOUCHING


def _nearest_points(
    line: Line, core: Sequence[complex], start: complex
) -> tuple[NearestPoint, complex]:
    """Return the nearest points of a line and of a body, searched from a point of the body."""
    point = start
    for _ in range(LOOKS):
        nearest_point = line.nearest(point)
        previous, point = point, nearest(core, nearest_point.point)
        if abs(point - previous) <= SAME:
            break
    return nearest_point, point
