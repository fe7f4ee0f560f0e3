"""The courses of wires and curves. The plane is complex here: a point is x + iy."""

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array, Values
from sandbox.model.joints import Wire
from sandbox.model.shapes import Curve

Points = NDArray[np.complex128]

PIECES = 4096
"""The number of pieces of a wire or curve, of equal s. Interpolated by quintics through six points,
smooth curves are right to rounding."""

FIRST = 1.0
"""How many pieces before the first point the angle is 0, where pieces are shorter at the ends."""

NEAR = 1e-9
"""How much points that should coincide may differ, as a share of the wire's size."""


def places(wire: Wire | Curve, values: Values, s: Array) -> Points:
    """Return the points of a wire or curve [m]; where there is none, it is not finite."""
    x, y = (coordinate.over(values, s) for coordinate in wire.curve)
    return np.asarray(x + 1j * y)


def along(wire: Wire | Curve, values: Values, pieces: int = PIECES) -> Points:
    """Return the points of a wire or curve at equal steps of s, with both ends: (n + 1,) [m]."""
    first, last = (end(values) for end in wire.s)
    return places(wire, values, np.linspace(first, last, pieces + 1))


def graded(wire: Wire | Curve, values: Values) -> tuple[Points, Points]:
    """Return points that lie ever closer towards both ends, and those half-way between them.

    s goes as the cosine of an angle, so that pieces are some 1000 times shorter where a curve may
    be no smooth function of s, as at the cusp of a cycloid; but not from 0, or the first were none.

    Returns
    -------
    The points (n + 1,) and those between (n,), at equal steps of that angle [m].
    """
    first, last = (end(values) for end in wire.s)
    begin = np.pi * FIRST / (PIECES + 2 * FIRST)
    way = np.cos(begin) - np.cos(np.linspace(begin, np.pi - begin, 2 * PIECES + 1))
    found = places(wire, values, first + (last - first) * way / way[-1])
    return found[::2], found[1::2]


def is_closed(points: Points) -> bool:
    """Whether a wire or curve ends where it begins."""
    return bool(abs(points[-1] - points[0]) <= NEAR * np.ptp(np.abs(points - points[0])))
