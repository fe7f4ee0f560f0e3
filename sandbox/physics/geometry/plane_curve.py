"""A plane curve: its points, the point nearest to another, and its curvature.

Everything is along the axes of its body, and a place on it is counted in the pieces of `Quintics`.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from typing import NamedTuple

import numpy as np

from sandbox.model.wires import Points
from sandbox.physics.geometry.distance import dot
from sandbox.physics.geometry.quintics import Quintics

KNOT = 16
"""How many pieces are between two places at which it is looked at first."""

QUADRATIC = 1e-6
"""Pieces, below which the course is as good as its own parabola."""

HALVINGS = 60
"""How often a foot is looked for; what Newton's method does not find is halved in on."""

STRAIGHT = 1.01
"""How many times as long as the straight ways between its points a course is, at the most."""

FOLLOWED = 0.125
"""The share of a course by which a foot may go on in a step."""

FLATTEST = 1e-9
"""1/m, the least curvature: what bends less is taken for a circle as large as this makes it."""

TURN = 1.0
"""rad, by which a stretch turns at the most, about."""

RISES = 1.001
"""How many times the curvature between them two bends have that are told apart."""

_GAUSS = tuple((0.5 + x, w) for x, w in ((-sqrt(0.15), 5 / 18), (0.0, 4 / 9), (sqrt(0.15), 5 / 18)))


class Foot(NamedTuple):
    """A point of a course.

    Attributes
    ----------
    at
        Where along it, in pieces.
    point
        [m].
    tangent
        The unit vector along it.
    bend
        The curvature, positive where it turns to the left; never 0 [1/m].
    """

    at: float
    point: complex
    tangent: complex
    bend: float


class Stretch(NamedTuple):
    """A part of a course that bends one way, and is nearest to anything beside it at one point.

    Attributes
    ----------
    first, last
        The knots at its ends.
    bend
        1 where it turns to the left, −1 to the right, 0 where it is straight.
    center, reach
        A circle around it [m].
    """

    first: int
    last: int
    bend: int
    center: complex
    reach: float


class Course:
    """A course through points at equal steps of its parameter, of a whole number of knots.

    Attributes
    ----------
    stretches
        The stretches of which the curve consists.
    ends
        The first and last points; none if they are the same.
    spacing
        How far it is from a knot to the next along it, at the most [m].
    """

    def __init__(self, points: Points) -> None:
        self._curve = Quintics(points)
        self._knots = points[::KNOT]
        self.spacing = STRAIGHT * KNOT * float(np.abs(np.diff(points)).max())
        ends = () if self._curve.closed else (0.0, float(self._curve.count))
        self.ends = tuple(self.look(at) for at in ends)
        self.stretches = self._cut()

    def knot(self, point: complex, stretch: Stretch | None = None) -> tuple[int, complex]:
        """Return which knot of the course, or of a stretch, is nearest to a point, and where."""
        first, last = self._range(stretch)
        way = self._knots[first : last + 1] - point
        near = first + int(np.argmin(way.real**2 + way.imag**2))
        return near, complex(self._knots[near])

    def foot(
        self, point: complex, stretch: Stretch | None = None, near: int | None = None
    ) -> Foot | None:
        """Return the nearest point of the course, or of a stretch of it; by its nearest knot.

        There is none where that would be an end of it; a point that is beside the end of one
        stretch, and so beside the beginning of the next, is beside the first of them alone.
        """
        first, last = self._range(stretch)
        near = self.knot(point, stretch)[0] if near is None else near
        low, high = max(near - 1, first) * KNOT, min(near + 1, last) * KNOT
        if near == first and self._ahead(first * KNOT, point) <= 0:
            return None
        if near == last and self._ahead(last * KNOT, point) > 0:
            return None
        return self._between(point, float(low), float(high), float(near * KNOT))

    def _range(self, stretch: Stretch | None) -> tuple[int, int]:
        """Return the first and the last knot of a stretch, or of the whole."""
        return (stretch.first, stretch.last) if stretch else (0, len(self._knots) - 1)

    def follow(self, point: complex, at: float) -> Foot:
        """Return the nearest point of the course that is near to a place on it."""
        reach = self._curve.count * FOLLOWED
        return self._between(point, at - reach, at + reach, at)

    def parallel(self, direction: complex, stretch: Stretch) -> Foot | None:
        """Return where a stretch that bends runs in a direction, None if it does nowhere."""
        low, high = float(stretch.first * KNOT), float(stretch.last * KNOT)
        at = (low + high) / 2
        if not stretch.bend or self._turned(low, direction) * self._turned(high, direction) > 0:
            return None
        if dot(self._curve.at(at)[1], direction) <= 0:
            return None
        for _ in range(HALVINGS):
            _, slope, bend = self._curve.at(at)
            turned = (direction.conjugate() * slope).imag
            if turned * stretch.bend > 0:
                high = at
            else:
                low = at
            steep = (direction.conjugate() * bend).imag
            step = -turned / steep if steep else 0.0
            if steep and abs(step) < QUADRATIC:
                return self.look(at + step)
            at = at + step if steep and low < at + step < high else (low + high) / 2
        return self.look(at)

    def look(self, at: float) -> Foot:
        """Return the point at a place."""
        point, slope, bend = self._curve.at(at)
        speed = abs(slope)
        curvature = (slope.conjugate() * bend).imag / speed**3
        if abs(curvature) < FLATTEST:
            curvature = FLATTEST
        return Foot(at, point, slope / speed, curvature)

    def length(self, start: float, end: float) -> float:
        """Return how long a short way along the course is [m], negative backwards."""
        way = end - start
        return way * sum(w * abs(self._curve.at(start + x * way)[1]) for x, w in _GAUSS)

    def _ahead(self, at: float, point: complex) -> float:
        """Return whether a point is ahead of a place, as a number, or behind it."""
        place, slope, _ = self._curve.at(at)
        return dot(slope, point - place)

    def _turned(self, at: float, direction: complex) -> float:
        """Return whether the course has turned to the left of a direction, as a number."""
        return (direction.conjugate() * self._curve.at(at)[1]).imag

    def _between(self, point: complex, low: float, high: float, at: float) -> Foot:
        """Return the nearest point between two places, by Newton's method."""
        for _ in range(HALVINGS):
            place, slope, bend = self._curve.at(at)
            away = point - place
            ahead = dot(slope, away)
            steepness = abs(slope) ** 2 - dot(bend, away)
            if ahead > 0:
                low = at
            else:
                high = at
            step = ahead / steepness if steepness > 0 else high - low
            if abs(step) < QUADRATIC:
                return self.look(at + step)
            at = at + step if low <= at + step <= high else (low + high) / 2
        return self.look(at)

    def _cut(self) -> tuple[Stretch, ...]:
        """Return the stretches: from one bend to the next, and none turns by much."""
        _, slope, bend = self._curve.over(np.arange(0, self._curve.count + 1, KNOT))
        speed = np.abs(slope)
        size = float(np.abs(self._knots - self._knots[0]).max())
        bends = (slope.conj() * bend).imag / speed**3
        bends[np.abs(bends) < FLATTEST] = FLATTEST
        bends[np.abs(bends) * size < QUADRATIC] = 0.0
        turns = np.abs(np.angle(slope[1:] / slope[:-1]))
        cuts = _cuts(bends, turns)
        return tuple(self._stretch(a, b, bends[a : b + 1]) for a, b in pairwise(cuts))

    def _stretch(self, first: int, last: int, bends: np.ndarray) -> Stretch:
        knots = self._knots[first : last + 1]
        center = (
            complex(knots.real.min() + knots.real.max(), knots.imag.min() + knots.imag.max()) / 2
        )
        reach = float(np.abs(knots - center).max() + np.abs(np.diff(knots)).max())
        return Stretch(first, last, int(np.sign(bends.sum())), center, reach)


@dataclass(frozen=True, slots=True)
class Side:
    """A stretch of a curve, with both of its sides.

    Attributes
    ----------
    body
        The body's index.
    course, stretch
        Of which course it is which part.
    half
        How far its two sides are from the course [m].
    """

    body: int
    course: Course
    stretch: Stretch
    half: float


def _cuts(bends: np.ndarray, turns: np.ndarray) -> list[int]:
    """Return the knots between stretches, the ends among them.

    Between two points that are nearest to something on the same side there is one where the course
    bends most; so it is cut there, where it begins to bend the other way, and where it has turned.
    """
    cuts, turned = [0], 0.0
    most, least = 0, abs(bends[0])  # since the last cut: where it bent most, and how little it did
    rising = False
    for knot in range(1, len(bends)):
        size = abs(bends[knot])
        turned += turns[knot - 1]
        if size > RISES * least:
            rising = True
        if size > abs(bends[most]):
            most = knot
        cut = None
        if bends[knot] * bends[knot - 1] < 0:
            cut = knot
        elif rising and RISES * size < abs(bends[most]) and most > cuts[-1]:
            cut = most
        elif turned > TURN:
            cut = knot
        least = min(least, size)
        if cut is not None and cut < len(bends) - 1:
            cuts.append(cut)
            turned = float(turns[cut:knot].sum())
            most, least, rising = knot, size, False
    return [*cuts, len(bends) - 1]
