"""Integrals by Gauss–Legendre quadrature."""

from array import array
from bisect import bisect_right
from collections.abc import Callable
from functools import cache

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.state.cancellation_points import cancellation_point

PANEL = 0.25
"""The length of the panels that an integral is made of."""
PIECES = 16
"""The number of pieces that an interval is divided into where the function is not smooth, and of
points at which the function is evaluated in each interval."""
MOST = 16
"""The largest number of intervals of one length that are divided in a panel."""
ROUNDING = 4 * float(np.finfo(float).eps)


@cache
def gauss(count: int) -> tuple[Array, Array]:
    """Return the nodes and weights of Gauss–Legendre quadrature from -1 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return nodes, weights


class Antiderivative:
    """The integral of a function of arrays from 0 to x, as a function of x alone.

    It is the sum over panels of one length, and over the last of them up to x. A panel is divided
    until the quadrature of each interval agrees with that of its pieces, so that jumps and corners
    are between intervals, and the error is one of rounding. It is larger if a panel has more than
    `MOST` jumps, or oscillations of less than a thousandth of its length. The sums are stored: a
    call costs the same at any x, and has the same bits whatever the order of calls.
    """

    def __init__(self, function: Callable[[Array], Array]) -> None:
        self._function = function
        self._panels, self._sum = 0, 0.0
        self._starts, self._sums = array("d"), array("d")  # intervals, and integrals up to them
        self._add_panel()

    def __call__(self, x: float) -> float:
        """Return the integral from 0 to x >= 0; not finite beyond values that are not."""
        while x >= PANEL * self._panels:
            cancellation_point()
            self._add_panel()
        i = max(bisect_right(self._starts, x) - 1, 0)
        start = self._starts[i]
        if x == start:
            return self._sums[i]
        values = self._values(np.array([start]), x - start)
        return self._sums[i] + float(_integral(values, x - start)[0])

    def _add_panel(self) -> None:
        starts, width = np.array([PANEL * self._panels]), PANEL
        found = list[tuple[float, float]]()
        tolerance = None
        while len(starts):
            piece = width / PIECES
            pieces = starts[:, None] + piece * np.arange(PIECES)
            parts = self._values(pieces, piece)
            if tolerance is None:
                tolerance = _rounding(parts, float(starts[0]))
            with np.errstate(all="ignore"):
                whole, each = _integral(self._values(starts, width), width), _integral(parts, piece)
                differ = ~(np.abs(whole - each.sum(axis=1)) <= tolerance)
            divided = differ & np.isfinite(each).any(axis=1)
            if np.count_nonzero(divided) > MOST or piece < np.spacing(starts[-1]):
                divided[:] = False
            found += zip(starts[~divided].tolist(), whole[~divided].tolist(), strict=True)
            starts, width = pieces[divided].ravel(), piece
        for start, integral in sorted(found):
            self._starts.append(start)
            self._sums.append(self._sum)
            self._sum += integral
        self._panels += 1

    def _values(self, starts: Array, width: float) -> Array:
        """Return the values at the points of intervals of one length: (..., points)."""
        points = width * (gauss(PIECES)[0] + 1) / 2
        return self._function(starts[..., None] + points)


def _integral(values: Array, width: float) -> Array:
    return np.asarray((values * gauss(PIECES)[1]).sum(axis=-1) * width / 2)


def _rounding(values: Array, x: float) -> float:
    """Return the error of an integral over a panel at x by rounding: of its values, and of x."""
    finite = values[np.isfinite(values)]
    if len(finite) < 2:
        return 0.0
    slope = float(np.median(np.abs(np.diff(finite)))) * len(finite) / PANEL
    return ROUNDING * PANEL * (float(np.abs(finite).max()) + slope * (x + PANEL))
