"""The root of a function of one number."""

from collections.abc import Callable
from math import inf

CLOSE = 1e-13
"""A function this close to 0 counts as 0."""

TRIES = 60


def root(function: Callable[[float], float], until: float) -> float:
    """Return where a function falls to 0 between 0 and another number; inf if it is not below it.

    By the rule of false position, whose end that stays counts for half (the Illinois method).
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
        if abs(now) <= CLOSE:
            return middle
        if now > 0:
            low, above, below = middle, now, below / 2
        else:
            high, below, above = middle, now, above / 2
    return high
