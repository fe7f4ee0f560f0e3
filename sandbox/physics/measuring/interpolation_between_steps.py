"""Values and crossings between two steps, from the cubic through four neighbouring samples.

The cubic is exact for the parabolas of uniformly accelerated motion. It uses no sample after the
interval unless a kink is among those before it, such as an impact or the end of slipping: then it
takes those of the other side, for which the curve is far smoother (ENO). If the interval itself has
a kink, there are two cubics, which meet where they intersect, or at the time of an impact that was
located: Harten's subcell resolution (J. Comput. Phys. 83, 1989).

For smooth runs, those of a scheme of order p > 2, the polynomial through p + 2 samples around the
interval is far more accurate: its error falls faster with the step.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from sandbox.model.expressions import Array

BISECTIONS = 60
"""A step halved this often is shorter than a float's rounding."""

CUBIC = 4
"""The samples that a cubic goes through."""

SMOOTHER = 10.0
"""The ratio of third differences from which on there is a kink."""

ROUNDING = 1e-12
"""The largest third difference that counts as rounding, relative to the samples."""

Curve = Callable[[float], float]
"""A quantity near an interval, s = −1 at its start and 0 at its end."""


def value_at(t: Array, samples: Array, at: float, *, smooth: int = 0) -> float:
    """Return the value at a time within the range of the samples [s].

    `smooth` is the order of a run in which nothing jumps; 0 if something may.
    """
    if at <= t[0] or len(t) == 1:
        return float(samples[0])
    end = min(max(int(np.searchsorted(t, at)), 1), len(t) - 1)
    s = float(at - t[end]) / float(t[end] - t[end - 1])
    pieces = _pieces(samples, end, None, smooth=smooth)
    return next(piece for piece in pieces if s <= piece.high or piece is pieces[-1]).curve(s)


def value_before(t: Array, samples: Array, at: float, first: int) -> float:
    """Return the value at a time [s] shortly before four samples, from index `first` on."""
    end = first + 3
    return _polynomial(samples[first : end + 1])(float(at - t[end]) / float(t[end] - t[first]) * 3)


def crossing(
    t: Array,
    samples: Array,
    level: float,
    direction: Literal["up", "down", "either"],
    *,
    smooth: int = 0,
    impacts: Sequence[float] = (),
) -> float | None:
    """Return when the samples first cross a value in a direction [s]; None if they never do.

    A start on the value itself is no crossing. `t` are the times [s], and `samples` the quantity at
    each. `smooth` is the order of a run in which nothing jumps; if it is 0, the quantity may turn
    or jump at `impacts`, known times [s].
    """
    above = samples - level
    rises = (above[:-1] < 0) & (above[1:] >= 0)
    falls = (above[:-1] > 0) & (above[1:] <= 0)
    ends = np.flatnonzero({"up": rises, "down": falls, "either": rises | falls}[direction]) + 1
    struck = {min(max(int(np.searchsorted(t, time)), 1), len(t) - 1): time for time in impacts}
    for end in sorted({*ends[:1].tolist(), *(e for e in struck if not len(ends) or e < ends[0])}):
        step = float(t[end] - t[end - 1])
        jump = float(struck[end] - t[end]) / step if end in struck else None
        for piece in _pieces(above, end, jump, smooth=smooth):
            if (s := _crossed(piece, direction)) is not None:
                return float(t[end] + s * step)
    return None


class _Piece(NamedTuple):
    """A part of an interval without a kink."""

    low: float
    high: float
    curve: Curve
    begins: float
    """The value from which it begins."""


def _crossed(piece: _Piece, direction: str) -> float | None:
    """Return where a piece crosses 0, from the value from which it begins; None if it does not."""
    begins, ends = piece.begins, piece.curve(piece.high)
    rises, falls = begins < 0 <= ends, begins > 0 >= ends
    if not {"up": rises, "down": falls, "either": rises or falls}[direction]:
        return None
    low, high, sign = piece.low, piece.high, 1.0 if begins > 0 else -1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        if sign * piece.curve(middle) > 0:
            low = middle
        else:
            high = middle
    return high


def _pieces(samples: Array, end: int, jump: float | None, *, smooth: int) -> list[_Piece]:
    """Return the parts of the interval that ends at a sample, with a curve for each."""
    begins = float(samples[end - 1])
    if smooth:
        return [_Piece(-1.0, 0.0, _around(samples, end, smooth + 2, smooth // 2), begins)]
    ahead = list(_ahead(samples, end))
    rough = [_roughness(samples, end + n) for n in ahead]
    best = int(np.argmin(rough))
    if rough[best] * SMOOTHER > rough[0]:
        best = 0
    before, after = samples[max(end - CUBIC, 0) : end], samples[end : end + CUBIC]
    sides = max(_third(before), _third(after))
    if rough[best] > max(SMOOTHER * sides, ROUNDING * np.abs(samples[end - 1 : end + 1]).max()):
        curves = _polynomial(before, 1), _polynomial(after, 1 - len(after))
        if (kink := _intersection(*curves) if jump is None else jump) is not None:
            left, right = (curve(kink) for curve in curves)
            return [
                _Piece(-1.0, kink, curves[0], begins),
                _Piece(kink, kink, curves[1], left),  # the jump
                _Piece(kink, 0.0, curves[1], right),
            ]
    return [_Piece(-1.0, 0.0, _around(samples, end, CUBIC, ahead[best]), begins)]


def _ahead(samples: Array, end: int) -> Iterator[int]:
    """Yield by how many samples a cubic over an interval may lie ahead of its end."""
    least = min(max(CUBIC - 1 - end, 0), len(samples) - 1 - end)
    yield from range(least, max(min(CUBIC - 2, len(samples) - 1 - end), least) + 1)


def _roughness(samples: Array, last: int) -> float:
    """Return the third difference of the four samples up to one."""
    return _third(samples[max(last - CUBIC + 1, 0) : last + 1])


def _third(samples: Array) -> float:
    """Return the third difference of four samples; infinite if there are fewer."""
    if len(samples) < CUBIC:
        return np.inf
    return abs(float(samples[3] - 3 * samples[2] + 3 * samples[1] - samples[0]))


def _intersection(left: Curve, right: Curve) -> float | None:
    """Return where two curves intersect within an interval; None if they do not."""
    low, high = -1.0, 0.0
    sign = left(low) - right(low)
    if not sign * (left(high) - right(high)) < 0:
        return None
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        if sign * (left(middle) - right(middle)) > 0:
            low = middle
        else:
            high = middle
    return high


def _around(samples: Array, end: int, count: int, ahead: int) -> Curve:
    """Return the polynomial through `count` samples, up to `ahead` samples after an interval."""
    last = min(max(end + ahead, count - 1), len(samples) - 1)
    return _polynomial(samples[max(last - count + 1, 0) : last + 1], end - last)


def _polynomial(samples: Array, ahead: int = 0) -> Curve:
    """Return Newton's backward differences through samples; the last one is at s = −`ahead`."""
    difference, terms = samples, list[float]()
    while len(difference):
        terms.append(float(difference[-1]))
        difference = np.diff(difference)

    def curve(s: float) -> float:
        s += ahead
        value, weight = 0.0, 1.0
        for order, term in enumerate(terms):
            value += weight * term
            weight *= (s + order) / (order + 1)
        return value

    return curve
