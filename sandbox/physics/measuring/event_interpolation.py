"""Values and crossings between two steps, from the cubic through four neighbouring samples.

The cubic uses no sample after the interval, so that an impact at its end does no harm, and is exact
for the parabolas of uniformly accelerated motion. For smooth runs, those of fourth order, the
quintic through six samples around the interval is far more accurate.
"""

from typing import Literal

import numpy as np

from sandbox.model.expressions import Array

BISECTIONS = 60
"""A step halved this often is shorter than a float's rounding."""


def value_at(t: Array, samples: Array, at: float, *, smooth: bool = False) -> float:
    """Return the value at a time within the range of the samples [s]."""
    if at <= t[0] or len(t) == 1:
        return float(samples[0])
    end = min(max(int(np.searchsorted(t, at)), 1), len(t) - 1)
    step = float(t[end] - t[end - 1])
    return _Polynomial(samples, end, smooth=smooth)(float(at - t[end]) / step)


def value_before(t: Array, samples: Array, at: float, first: int) -> float:
    """Return the value at a time [s] shortly before four samples, from index `first` on."""
    end = first + 3
    return _Polynomial(samples, end)(float(at - t[end]) / float(t[end] - t[first]) * 3)


def crossing(
    t: Array,
    samples: Array,
    level: float,
    direction: Literal["up", "down", "either"],
    *,
    smooth: bool = False,
) -> float | None:
    """Return when the samples first cross a value [s]; None if they never do.

    A start on the value itself is no crossing.
    """
    above = samples - level
    rises = (above[:-1] < 0) & (above[1:] >= 0)
    falls = (above[:-1] > 0) & (above[1:] <= 0)
    found = {"up": rises, "down": falls, "either": rises | falls}[direction]
    if not found.any():
        return None
    end = int(np.argmax(found)) + 1
    between = _Polynomial(above, end, smooth=smooth)
    low, high = -1.0, 0.0
    sign = 1.0 if above[end - 1] > 0 else -1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        if sign * between(middle) > 0:
            low = middle
        else:
            high = middle
    return float(t[end] + high * (t[end] - t[end - 1]))


class _Polynomial:
    """Newton's backward differences: s = 0 at the interval's end, −1 at the sample before.

    The cubic through the four samples up to the end; for smooth runs, the quintic through three on
    either side. If there are too few samples before the interval, it uses later ones.
    """

    def __init__(self, samples: Array, end: int, *, smooth: bool = False) -> None:
        degree, behind = (5, 2) if smooth else (3, 0)
        last = min(max(end + behind, degree), len(samples) - 1)
        self._ahead = last - end
        difference = samples[max(last - degree, 0) : last + 1]
        self._terms: list[float] = []
        while len(difference):
            self._terms.append(float(difference[-1]))
            difference = np.diff(difference)

    def __call__(self, s: float) -> float:
        s -= self._ahead
        value, weight = 0.0, 1.0
        for order, term in enumerate(self._terms):
            value += weight * term
            weight *= (s + order) / (order + 1)
        return value
