"""Finds roots of functions of one number."""

from collections.abc import Callable
from math import inf

CLOSE = 1e-13
"""The absolute value below which a function counts as 0."""

TRIES = 60


def root(function: Callable[[float], float], until: float, close: float = CLOSE) -> float:
    """Return a root of a falling function between 0 and `until`; inf if it is still positive there.

    Absolute values up to `close` count as 0. It uses the Illinois method: false position, with the
    value at an end halved that is retained twice in a row.
    """
    low, high, retained = 0.0, until, 0
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
            low, above, below = middle, now, below / 2 if retained == 1 else below
        else:
            high, below, above = middle, now, above / 2 if retained == -1 else above
        retained = 1 if now > 0 else -1
    return high


class SecantMethod:
    """Finds x = f(x) between 0 and `upper` by the secant method; f is given point by point.

    `last` is a point (x, f(x)) to begin with; without it, f of the first point is tried next.
    """

    def __init__(self, upper: float, last: tuple[float, float] | None = None) -> None:
        self._upper = upper
        self._last = (last[0], last[0] - last[1]) if last else None

    def following(self, x: float, value: float) -> float:
        """Return the next x to try after one with a value f(x)."""
        last, residual = self._last, x - value
        self._last = x, residual
        if last is None or residual == last[1]:
            return value
        zero = x - residual * (x - last[0]) / (residual - last[1])
        return zero if 0 < zero < self._upper else value
