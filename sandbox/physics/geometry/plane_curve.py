"""A plane curve: its points, the point nearest to another point, and its curvature.

All points are in the axes of the curve's body. The curve's parameter counts pieces of `Quintics`.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import fsum, sqrt
from typing import NamedTuple

import numpy as np

from sandbox.model.wire_points import Points
from sandbox.physics.geometry.outline_distance import dot
from sandbox.physics.geometry.quintic_curve import Quintics

KNOT = 16
"""The number of pieces between two knots, the points that a search tries first."""

QUADRATIC = 1e-6
"""Pieces, the Newton step below which the middle line equals its own parabola up to rounding."""

HALVINGS = 60
"""The most iterations of a search, by Newton's method or else bisection."""

STRAIGHT = 1.01
"""The upper bound of a middle line's length over the chords between its points."""

FOLLOWED = 0.125
"""The largest fraction of a middle line by which a foot can move in a step."""

FLATTEST = 1e-9
"""1/m, the lower bound of the curvature; flatter parts count as a circle with this curvature."""

TURN = 1.0
"""rad, the approximate upper bound of the angle by which a stretch turns."""

RISES = 1.001
"""The ratio of two maxima of the curvature to the minimum between them from which they count as
separate."""

_GAUSS = tuple((0.5 + x, w) for x, w in ((-sqrt(0.15), 5 / 18), (0.0, 4 / 9), (sqrt(0.15), 5 / 18)))


class CurvePoint(NamedTuple):
    """A point of a middle line."""

    parameter: float
    """The parameter, in pieces."""
    point: complex
    """The position [m]."""
    tangent: complex
    """The unit tangent."""
    curvature: float
    """The curvature, positive where the middle line turns left; never 0 [1/m]."""


class Stretch(NamedTuple):
    """A part of a middle line that bends one way, with one nearest point to anything beside it."""

    first: int
    last: int
    """The knots at its ends."""
    turn_sign: int
    """1 if it turns left, −1 if right, 0 if it is straight."""
    center: complex
    radius: float
    """The centre and radius of a circle around it [m]."""


class MiddleLine:
    """The middle line of a curve, through points at equal steps of its parameter.

    The number of pieces between the points is a multiple of `KNOT`. The line has `stretches`, its
    parts; `ends`, its first and last point, or none if it is closed; `knots`, points along it [m];
    and `spacing`, the largest length between successive knots [m].
    """

    def __init__(self, points: Points) -> None:
        self._curve = Quintics(points)
        self.knots = points[::KNOT]
        self.spacing = STRAIGHT * KNOT * float(np.abs(np.diff(points)).max())
        ends = () if self._curve.closed else (0.0, float(self._curve.count))
        self.ends = tuple(self.point_at(at) for at in ends)
        self.stretches = self._split()

    def nearest_knot(self, point: complex, stretch: Stretch | None = None) -> tuple[int, complex]:
        """Return the knot nearest to a point, on the line or a stretch, and its position [m]."""
        first, last = self._range(stretch)
        offsets = self.knots[first : last + 1] - point
        index = first + int(np.argmin(offsets.real**2 + offsets.imag**2))
        return index, complex(self.knots[index])

    def foot_point(
        self, point: complex, stretch: Stretch | None = None, knot: int | None = None
    ) -> CurvePoint | None:
        """Return the foot point on the middle line or a stretch, searched around the nearest knot.

        None if the nearest point is an end. A point beside the common end of two stretches has a
        foot point on the first of them only.
        """
        first, last = self._range(stretch)
        knot = self.nearest_knot(point, stretch)[0] if knot is None else knot
        low, high = max(knot - 1, first) * KNOT, min(knot + 1, last) * KNOT
        if knot == first and self._is_ahead(first * KNOT, point) <= 0:
            return None
        if knot == last and self._is_ahead(last * KNOT, point) > 0:
            return None
        return self._foot_between(point, float(low), float(high), float(knot * KNOT))

    def _range(self, stretch: Stretch | None) -> tuple[int, int]:
        """Return the first and last knot of a stretch, or of the whole middle line."""
        return (stretch.first, stretch.last) if stretch else (0, len(self.knots) - 1)

    def foot_point_near(self, point: complex, at: float) -> CurvePoint:
        """Return the foot point on the middle line near a parameter."""
        reach = self._curve.count * FOLLOWED
        return self._foot_between(point, at - reach, at + reach, at)

    def parallel(self, direction: complex, stretch: Stretch) -> CurvePoint | None:
        """Return the point where a bent stretch runs in a direction; None if there is none."""
        low, high = float(stretch.first * KNOT), float(stretch.last * KNOT)
        at = (low + high) / 2
        if (
            not stretch.turn_sign
            or self._is_left(low, direction) * self._is_left(high, direction) > 0
        ):
            return None
        if dot(self._curve.at(at)[1], direction) <= 0:
            return None
        for _ in range(HALVINGS):
            _, slope, bend = self._curve.at(at)
            sine = (direction.conjugate() * slope).imag
            if sine * stretch.turn_sign > 0:
                high = at
            else:
                low = at
            slope_of_sine = (direction.conjugate() * bend).imag
            step = -sine / slope_of_sine if slope_of_sine else 0.0
            if slope_of_sine and abs(step) < QUADRATIC:
                return self.point_at(at + step)
            at = at + step if slope_of_sine and low < at + step < high else (low + high) / 2
        return self.point_at(at)

    def lowest(self, direction: complex, stretch: Stretch) -> complex:
        """Return the point of a stretch that is farthest against a direction [m]."""
        ends = [complex(self.knots[knot]) for knot in (stretch.first, stretch.last)]
        foot = self.parallel(-stretch.turn_sign * 1j * direction, stretch)
        return min([foot.point] if foot else ends, key=lambda point: dot(point, direction))

    def point_at(self, at: float) -> CurvePoint:
        """Return the point at a parameter."""
        point, slope, bend = self._curve.at(at)
        speed = abs(slope)
        curvature = (slope.conjugate() * bend).imag / speed**3
        if abs(curvature) < FLATTEST:
            curvature = FLATTEST
        return CurvePoint(at, point, slope / speed, curvature)

    def length(self, start: float, end: float) -> float:
        """Return the arc length between two close parameters [m], negative backwards."""
        interval = end - start
        return interval * fsum(w * abs(self._curve.at(start + x * interval)[1]) for x, w in _GAUSS)

    def _is_ahead(self, at: float, point: complex) -> float:
        """Return a positive number if a point is ahead of a parameter, negative if behind it."""
        position, slope, _ = self._curve.at(at)
        return dot(slope, point - position)

    def _is_left(self, at: float, direction: complex) -> float:
        """Return a positive number if the tangent is to the left of a direction, else negative."""
        return (direction.conjugate() * self._curve.at(at)[1]).imag

    def _foot_between(self, point: complex, low: float, high: float, at: float) -> CurvePoint:
        """Return the foot point between two parameters, by Newton's method and bisection."""
        for _ in range(HALVINGS):
            position, slope, bend = self._curve.at(at)
            offset = point - position
            ahead = dot(slope, offset)
            steepness = abs(slope) ** 2 - dot(bend, offset)
            if ahead > 0:
                low = at
            else:
                high = at
            step = ahead / steepness if steepness > 0 else high - low
            if abs(step) < QUADRATIC:
                return self.point_at(at + step)
            at = at + step if low <= at + step <= high else (low + high) / 2
        return self.point_at(at)

    def _split(self) -> tuple[Stretch, ...]:
        """Return the stretches, which end at maxima of curvature, inflections, or large turns."""
        _, slope, bend = self._curve.over(np.arange(0, self._curve.count + 1, KNOT))
        speed = np.abs(slope)
        size = float(np.abs(self.knots - self.knots[0]).max())
        bends = (slope.conj() * bend).imag / speed**3
        bends[np.abs(bends) < FLATTEST] = FLATTEST
        bends[np.abs(bends) * size < QUADRATIC] = 0.0
        turns = np.abs(np.angle(slope[1:] / slope[:-1]))
        cuts = _cuts(bends, turns)
        return tuple(self._stretch(a, b, bends[a : b + 1]) for a, b in pairwise(cuts))

    def _stretch(self, first: int, last: int, bends: np.ndarray) -> Stretch:
        knots = self.knots[first : last + 1]
        center = (
            complex(knots.real.min() + knots.real.max(), knots.imag.min() + knots.imag.max()) / 2
        )
        reach = float(np.abs(knots - center).max() + np.abs(np.diff(knots)).max())
        return Stretch(first, last, int(np.sign(bends.sum())), center, reach)


@dataclass(frozen=True, slots=True)
class Side:
    """A stretch of a curve, with both of its sides."""

    body: int
    """The body's index."""
    middle_line: MiddleLine
    stretch: Stretch
    """The middle line, and the part of it."""
    half: float
    """The distance of the two sides from the middle line, half the thickness [m]."""


def _cuts(bends: np.ndarray, turns: np.ndarray) -> list[int]:
    """Return the knots between stretches, and the two ends.

    Between two foot points of the same point there is a maximum of curvature. So the middle line is
    cut at the maxima, where the curvature changes sign, and after each turn by `TURN`.
    """
    cuts, turned = [0], 0.0
    # since the last cut: the knot of the largest curvature, and the smallest curvature
    sharpest, least_curvature = 0, abs(bends[0])
    rising = False
    for knot in range(1, len(bends)):
        size = abs(bends[knot])
        turned += turns[knot - 1]
        if size > RISES * least_curvature:
            rising = True
        if size > abs(bends[sharpest]):
            sharpest = knot
        cut = None
        if bends[knot] * bends[knot - 1] < 0:
            cut = knot
        elif rising and RISES * size < abs(bends[sharpest]) and sharpest > cuts[-1]:
            cut = sharpest
        elif turned > TURN:
            cut = knot
        least_curvature = min(least_curvature, size)
        if cut is not None and cut < len(bends) - 1:
            cuts.append(cut)
            turned = float(turns[cut:knot].sum())
            sharpest, least_curvature, rising = knot, size, False
    return [*cuts, len(bends) - 1]
