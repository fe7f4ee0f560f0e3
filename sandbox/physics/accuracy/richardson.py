"""The errors of runs with smaller and smaller steps, by Richardson's extrapolation."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf, log2

from sandbox.physics.accuracy.compared_runs import Watched, apart, size, unit
from sandbox.physics.measuring.recording import Trace

LEAST_ORDER = 0.5
"""Differences that fall more slowly than this power of the step show no order."""

ORDERS = {"leapfrog": 2, "fourth-order": 4, "symplectic-euler": 1, "explicit-euler": 1}
"""The orders of the schemes; errors are not expected to fall faster."""

ROUGHLY = 2.0
"""The error of two runs without an order, as a multiple of their difference: rounding is random."""

ROUNDING = 1e-15
"""Differences below this share of the quantity mean nothing."""


@dataclass(frozen=True, slots=True)
class Errors:
    """The errors of some runs in a quantity, each of half the step of the one before [unit].

    Attributes
    ----------
    of
        The errors.
    order
        The power of the step with which they fall; None if there is none.
    unit
        The scale to which they are relative; 1 where the value itself is zero.
    rise
        The power of the rate with which they grow, if they are rounding; else 0.
    """

    of: tuple[float, ...]
    order: float | None
    unit: float
    rise: float

    @property
    def relative(self) -> tuple[float, ...]:
        """The errors as a check's."""
        return tuple(error / self.unit for error in self.of)


def extrapolated(traces: Sequence[Trace], item: Watched) -> Errors | None:
    """Return the errors of at least two runs in what is watched, by the differences between them.

    e_n = (y_n − y_{n−1}) / (2^p − 1) is that of the last, with the order p by which the differences
    fall, but not more than the scheme's; each other's is its difference from the last, and that.
    Where no order shows, the error of the last counts as twice the difference.

    None if an instant comes in none of the runs.
    """
    steps = [apart(a, b, item) for a, b in pairwise(traces)]
    if all(step is None for step in steps):
        return None
    differences = [inf if step is None else step for step in steps]
    floor = ROUNDING * size(traces[-1], item)
    order, jump = _order(differences, floor, ORDERS[traces[-1].stepping.scheme])
    last = jump / (2**order - 1) if order else ROUGHLY * jump
    whole = (apart(trace, traces[-1], item) for trace in traces[:-1])
    rise = 0.0 if order else _rise(differences)
    errors = (*(inf if w is None else w + last for w in whole), last)
    return Errors(errors, order, unit(traces, item, last), rise)


def _rise(differences: Sequence[float]) -> float:
    """Return by which power of the rate differences grow, if they do each time.

    No more than 2, that of an acceleration: the rounding of places over the square of the step.
    """
    last = differences[-3:]
    grows = len(last) > 1 and last[0] > 0 and all(a < b < inf for a, b in pairwise(last))
    return min(log2(last[-1] / last[0]) / (len(last) - 1), 2.0) if grows else 0.0


def _order(differences: Sequence[float], floor: float, most: int) -> tuple[float | None, float]:
    """Return the order by which differences fall, and the last of them.

    Impacts are found at steps, and how late each comes is a matter of chance: what falls now more
    and now less is of first order at the best, and the larger of the last two counts. Two runs may
    agree by chance, too: no difference counts for less than the one before and the order allow.
    """
    last = differences[-1]
    if len(differences) > 1 and floor < differences[-2] / 2**most < inf:
        last = max(last, differences[-2] / 2**most)
    if len(differences) < 2 or not floor < last < inf:
        return None, last
    order = log2(differences[-2] / last) if 0 < differences[-2] < inf else 0.0
    if order >= LEAST_ORDER:
        return min(order, most), last
    first, last = max(differences[:2]), max(last, differences[-2])
    if len(differences) < 4 or not 0 < last < first < inf:
        return None, last
    order = log2(first / last) / (len(differences) - 2)
    return (min(order, 1.0) if order >= LEAST_ORDER else None), last
