"""The summary of a sweep: orders, the best points, and the comparison with stock pymunk."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from sandbox.model.level import Scheme
from validation.cost.sweep import NAIVE, OURS, Point, Sweep

TARGETS = (1e-2, 1e-3, 1e-4, 1e-6, 1e-9)

ROUNDING = 1e-11
"""The error below which it is rounding, and shows no order."""

LARGE = 0.1
"""The error above which it is too large to show an order."""

SAME = 1.2
"""The ratio of two costs below which they count as equal."""

LEAST = 1e-16
"""The substitute for an error of zero: the precision of a float."""


@dataclass(frozen=True, slots=True)
class Headline:
    """The sandbox at the level's own rate, compared with stock pymunk."""

    error: float
    seconds_per_second: float
    """Those of the sandbox."""
    naive_error: float
    """The least error that pymunk reaches in the same time."""
    closer: float
    """The ratio of pymunk's error to ours in the same time."""
    cheaper: float
    """The ratio of pymunk's time to ours for the same error; extrapolated if no run reaches it."""


def order(points: Iterable[Point], scheme: Scheme) -> float | None:
    """Return the power of the step with which the error falls; None if it is rounding, or fails."""
    chosen = {p.rate: p.error for p in points if p.scheme == scheme and ROUNDING < p.error < LARGE}
    if len(chosen) < 3:
        return None
    slope = np.polyfit(np.log(list(chosen)), np.log(list(chosen.values())), 1)[0]
    return -float(slope)


def pareto(points: Sequence[Point]) -> list[int]:
    """Return the indices of the points on the Pareto front of cost and error, cheapest first."""
    found: list[int] = []
    least = inf
    for i in sorted(range(len(points)), key=lambda i: _by_cost(points[i])):
        if isfinite(points[i].seconds_per_second) and points[i].error < least:
            least = points[i].error
            found.append(i)
    return found


def _by_cost(point: Point) -> tuple[float, float]:
    cost = point.seconds_per_second
    return (cost if isfinite(cost) else inf), point.error


def cost_to_reach(points: Iterable[Point], target: float) -> float | None:
    """Return the least cost [s/s] with an error up to a bound; None if there is none."""
    costs = [p.seconds_per_second for p in points if p.error <= target]
    return min(costs, default=None)


def own(sweep: Sweep) -> Point | None:
    """Return our cheapest point at the level's own rate; None if every run failed."""
    here = [p for p in sweep.points if p.scheme == OURS and p.rate == sweep.own_rate]
    return min(
        (p for p in here if isfinite(p.error)), key=lambda p: p.seconds_per_second, default=None
    )


def next_digit(sweep: Sweep) -> float | None:
    """Return the cost of one more digit, as a multiple of the level's cost.

    It is that of the cheapest setting with a tenth of the error. None if the error is rounding, or
    no run of the sweep is that accurate.
    """
    here = own(sweep)
    if here is None or here.error <= ROUNDING:
        return None
    cost = cost_to_reach((p for p in sweep.points if p.scheme != NAIVE), here.error / 10)
    return None if cost is None else cost / here.seconds_per_second


def failed(sweeps: Iterable[Sweep]) -> list[str]:
    """Return the levels that cannot be run at their own rate."""
    return [s.level for s in sweeps if s.failure or (s.points and own(s) is None)]


def headline(sweep: Sweep) -> Headline | None:
    """Return the comparison of the sandbox with stock pymunk; None if either does not run."""
    ours = own(sweep)
    naive = [p for p in sweep.points if p.scheme == NAIVE and isfinite(p.error)]
    if ours is None or not naive:
        return None
    cost, error = ours.seconds_per_second, max(ours.error, LEAST)
    affordable = [p.error for p in naive if p.seconds_per_second <= SAME * cost]
    theirs = min(affordable or [min(naive, key=_by_cost).error])
    return Headline(
        ours.error, cost, theirs, max(theirs, LEAST) / error, _cost_of(naive, error) / cost
    )


def _cost_of(points: Sequence[Point], error: float) -> float:
    """Return the cost of an error, extrapolated from the finest run if no run reaches it."""
    reached = cost_to_reach(points, error)
    if reached is not None:
        return reached
    finest = min(points, key=lambda p: p.error)
    power = order(points, finest.scheme) or 1.0
    return finest.seconds_per_second * (finest.error / error) ** (1 / max(power, 0.5))
