"""The points of wires and curves in the complex plane, x + iy."""

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array, Values
from sandbox.model.joints import Wire
from sandbox.model.shapes import Curve

Points = NDArray[np.complex128]

PIECES = 4096
"""The number of pieces of a wire or curve, of equal length in s. Interpolation by quintics through
six points is then exact to rounding for smooth curves."""

FIRST = 1.0
"""The number of pieces between the angle 0 and the first point of a graded curve."""

NEAR = 1e-9
"""The tolerance for coincident points, as a share of the wire's size."""


def points_at(wire: Wire | Curve, values: Values, s: Array) -> Points:
    """Return the points of a wire or curve [m]; not finite where it has none."""
    x, y = (coordinate.over(values, s) for coordinate in wire.curve)
    return np.asarray(x + 1j * y)


def along(wire: Wire | Curve, values: Values, pieces: int = PIECES) -> Points:
    """Return the points of a wire or curve at equal steps of s, with both ends: (n + 1,) [m]."""
    first, last = (end(values) for end in wire.s)
    return points_at(wire, values, np.linspace(first, last, pieces + 1))


def graded(wire: Wire | Curve, values: Values) -> tuple[Points, Points]:
    """Return points that are closer towards both ends, (n + 1,), and the n between them [m].

    s is the cosine of an angle with equal steps, so that pieces are some 1000 times shorter where a
    curve may not be a smooth function of s, as at the cusp of a cycloid. The angle does not begin
    at 0, where the first piece would vanish.
    """
    first, last = (end(values) for end in wire.s)
    begin = np.pi * FIRST / (PIECES + 2 * FIRST)
    cosine = np.cos(begin) - np.cos(np.linspace(begin, np.pi - begin, 2 * PIECES + 1))
    found = points_at(wire, values, first + (last - first) * cosine / cosine[-1])
    return found[::2], found[1::2]


def is_closed(points: Points) -> bool:
    """Whether a wire or curve ends where it begins."""
    return bool(abs(points[-1] - points[0]) <= NEAR * np.ptp(np.abs(points - points[0])))
