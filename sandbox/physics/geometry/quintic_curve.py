"""A smooth curve through points at equal steps of its parameter: quintics through six points each.

The parameter counts the pieces between the points. The plane is complex here.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from sandbox.model.expressions import Values
from sandbox.model.joints import Wire
from sandbox.model.wire_points import PIECES, Points, along, graded, is_closed
from sandbox.physics.engine.space_arrays import Integers

_FIT = np.linalg.inv(np.vander(np.arange(-2.0, 4.0), increasing=True))
_BEFORE = np.array([6.0, -15.0, 20.0, -15.0, 6.0, -1.0])
"""The weights of six points that extrapolate their quintic to one point earlier."""

BETTER = 0.1
"""The largest error of points that are closer together at the ends, over the error of equal steps,
for which they are used."""


class Quintics:
    """A curve of `count` pieces through points (n + 1,) [m]; it is closed if its ends meet."""

    def __init__(self, points: Points) -> None:
        self.closed = is_closed(points)
        self._table = _quintics(points, self.closed)
        self.count = len(self._table)
        self._pieces: dict[int, list[complex]] = {}  # a cache: a run needs few of them repeatedly

    def over(self, parameters: Integers) -> tuple[Points, Points, Points]:
        """Return the results of `at` for many ends of pieces, (k,), at once."""
        piece = np.minimum(parameters, self.count - 1)
        u = parameters - piece
        a, b, c, d, e, f = self._table[piece].T
        return (
            a + u * (b + u * (c + u * (d + u * (e + u * f)))),
            b + u * (2 * c + u * (3 * d + u * (4 * e + u * 5 * f))),
            2 * c + u * (6 * d + u * (12 * e + u * 20 * f)),
        )

    def at(self, parameter: float) -> tuple[complex, complex, complex]:
        """Return the point [m], and its first and second derivative by the parameter."""
        count = self.count
        piece = (
            int(parameter // 1) % count if self.closed else min(max(int(parameter), 0), count - 1)
        )
        u = parameter % count - piece if self.closed else parameter - piece
        if piece not in self._pieces:
            self._pieces[piece] = self._table[piece].tolist()
        a, b, c, d, e, f = self._pieces[piece]
        return (
            a + u * (b + u * (c + u * (d + u * (e + u * f)))),
            b + u * (2 * c + u * (3 * d + u * (4 * e + u * 5 * f))),
            2 * c + u * (6 * d + u * (12 * e + u * 20 * f)),
        )


def points_along(wire: Wire, values: Values) -> Points:
    """Return the points of a wire for quintics through them: (n + 1,) [m].

    They are at equal steps of the wire's parameter, or closer at its ends if that is more accurate.
    """
    even = along(wire, values, 2 * PIECES)
    if is_closed(even):
        return even[::2]
    closer, between = graded(wire, values)
    return closer if _off(closer, between) < BETTER * _off(even[::2], even[1::2]) else even[::2]


def _off(points: Points, between: Points) -> float:
    """Return the largest distance of quintics through points from given midpoints [m]."""
    halves = _quintics(points, is_closed(points)) @ 0.5 ** np.arange(6)
    off = np.abs(halves - between)
    return float(off.max()) if np.isfinite(off).all() else np.inf


def _quintics(points: Points, closed: bool) -> Points:
    """Return the coefficients of each piece, the quintic through its six nearest points."""
    if closed:
        around = np.concatenate((points[-3:-1], points, points[1:3]))
    else:
        around = points
        for _ in range(2):
            earlier, later = _BEFORE @ around[:6], _BEFORE @ around[:-7:-1]
            around = np.concatenate(([earlier], around, [later]))
    return np.asarray(sliding_window_view(around, 6) @ _FIT.T)
