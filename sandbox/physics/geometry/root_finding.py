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


def secant(
    first: tuple[float, float], second: tuple[float, float], other: float, most: float
) -> float:
    """Return where a line through two points (x, y) is 0; `other` if not between 0 and `most`."""
    (start, before), (end, after) = first, second
    if after == before:
        return other
    zero = end - after * (end - start) / (after - before)
    return zero if 0 < zero < most else other
