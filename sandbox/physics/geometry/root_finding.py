"""Finds roots of functions of one number."""

from collections.abc import Callable
from math import inf

CLOSE = 1e-13
"""The absolute value below which a function counts as 0."""

TRIES = 60


def root(function: Callable[[float], float], until: float, close: float = CLOSE) -> float:
    """Return a root of a falling function between 0 and `until`; inf if it is still positive there.

    Absolute values up to `close` count as 0. It uses the Illinois method, false position with the
    value at a retained end halved.
    """
    low, high = 0.0, until
    above, below = function(low), function(high)
    if below > 0:
        return inf
    if above <= 0:
        return low
    for _ in range(TRIES):
        middle = (low * below - high * above) / (below - above)
        now = function(middle)
        if abs(now) <= close:
            return middle
        if now > 0:
            low, above, below = middle, now, below / 2
        else:
            high, below, above = middle, now, above / 2
    return high


class SecantMethod:
    """Finds x = f(x) between 0 and `most` by the secant method; f is given point by point.

    `known` is a point (x, f(x)) to begin with; without it, f of the first point is tried next.
    """

    def __init__(self, most: float, known: tuple[float, float] | None = None) -> None:
        self._most = most
        self._known = (known[0], known[0] - known[1]) if known else None

    def following(self, x: float, value: float) -> float:
        """Return the next x to try after one with a value f(x)."""
        known, off = self._known, x - value
        self._known = x, off
        if known is None or off == known[1]:
            return value
        zero = x - off * (x - known[0]) / (off - known[1])
        return zero if 0 < zero < self._most else value
