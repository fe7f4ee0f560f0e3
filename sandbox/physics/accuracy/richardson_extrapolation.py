"""The errors of runs with smaller and smaller steps, by Richardson extrapolation."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf, log2

from sandbox.physics.accuracy.compared_runs import (
    Watched,
    error_unit,
    item_scale,
    largest_difference,
)
from sandbox.physics.measuring.recording import Trace

LEAST_ORDER = 0.5
"""The least power of the step with which differences must fall to show an order."""

ROUGHLY = 2.0
"""The error without an order, as a multiple of the last difference: rounding is random."""

ROUNDING = 1e-15
"""The largest relative difference that counts as rounding."""


@dataclass(frozen=True, slots=True)
class Errors:
    """The errors of runs in a quantity, each with half the step of the one before [its unit]."""

    absolute: tuple[float, ...]
    """The errors of the runs."""
    order: float | None
    """The power of the step with which they fall; None if there is none."""
    unit: float
    """The scale of relative errors; 1 where the value itself is zero."""
    rounding_growth: float
    """The power of the rate with which they grow, if they are due to rounding; else 0."""
    agrees_by_chance: bool = False
    """Whether the last two runs differ by less than the order of the scheme explains."""

    @property
    def relative(self) -> tuple[float, ...]:
        """The relative errors, as for a check."""
        return tuple(error / self.unit for error in self.absolute)


def extrapolated(traces: Sequence[Trace], item: Watched) -> Errors | None:
    """Return the errors of at least two runs in a quantity, from the differences between them.

    The error of the last run is e_n = |y_n − y_{n−1}| / (2^p − 1), where p is the order with which
    the differences fall, at most that of the scheme. The error of any other run is its difference
    from the last, plus e_n. Without an order, e_n is taken as twice the difference.

    None if the instant occurs in none of the runs.
    """
    steps = [largest_difference(a, b, item) for a, b in pairwise(traces)]
    if all(step is None for step in steps):
        return None
    differences = [inf if step is None else step for step in steps]
    floor = ROUNDING * item_scale(traces[-1], item)
    order, jump = _order(differences, floor, traces[-1].stepping.order)
    last = jump / (2**order - 1) if order else ROUGHLY * jump
    to_last = (largest_difference(trace, traces[-1], item) for trace in traces[:-1])
    growth = 0.0 if order else _rounding_growth(differences)
    errors = (*(inf if w is None else w + last for w in to_last), last)
    by_chance = jump > differences[-1]
    return Errors(errors, order, error_unit(traces, item, last), growth, agrees_by_chance=by_chance)


def _rounding_growth(differences: Sequence[float]) -> float:
    """Return the power of the rate with which differences grow; 0 if they do not grow every time.

    At most 2, as for an acceleration: the rounding of positions over the square of the step.
    """
    last = differences[-3:]
    grows = len(last) > 1 and last[0] > 0 and all(a < b < inf for a, b in pairwise(last))
    return min(log2(last[-1] / last[0]) / (len(last) - 1), 2.0) if grows else 0.0


def _order(
    differences: Sequence[float], floor: float, scheme_order: int
) -> tuple[float | None, float]:
    """Return the order with which differences fall, and the last difference.

    Impacts are found at steps, and how late is a matter of chance: differences that fall
    irregularly are of first order at best, and the larger of the last two counts. Two runs may also
    agree by chance, so no difference counts for less than the one before over 2^p.
    """
    last = differences[-1]
    if len(differences) > 1 and floor < differences[-2] / 2**scheme_order < inf:
        last = max(last, differences[-2] / 2**scheme_order)
    if len(differences) < 2 or not floor < last < inf:
        return None, last
    order = log2(differences[-2] / last) if 0 < differences[-2] < inf else 0.0
    if order >= LEAST_ORDER:
        return min(order, scheme_order), last
    first, last = max(differences[:2]), max(last, differences[-2])
    if len(differences) < 4 or not 0 < last < first < inf:
        return None, last
    order = log2(first / last) / (len(differences) - 2)
    return (min(order, 1.0) if order >= LEAST_ORDER else None), last
