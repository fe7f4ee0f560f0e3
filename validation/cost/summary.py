"""The summary of a sweep: orders, the best points, and the comparison with stock pymunk."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from sandbox.model.level import Scheme
from validation.cost.sweep import NAIVE, OURS, Point, Sweep

TARGETS = (1e-2, 1e-3, 1e-4, 1e-6, 1e-9)

ROUNDING = 1e-11
"""An error below this is rounding, and shows no order."""

LARGE = 0.1
"""An error above this is too large to show an order."""

SAME = 1.2
"""Two costs are the same if their ratio is below this."""

LEAST = 1e-16
"""An error of zero counts as that of a float."""


@dataclass(frozen=True, slots=True)
class Headline:
    """Ours at the level's own rate, beside stock pymunk.

    Attributes
    ----------
    error, seconds_per_second
        Ours.
    naive_error
        The least that pymunk reaches in the same time.
    closer
        How much smaller our error is in the same time.
    cheaper
        How much longer pymunk takes to come as close; by its order where no run came so far.
    """

    error: float
    seconds_per_second: float
    naive_error: float
    closer: float
    cheaper: float


def order(points: Iterable[Point], scheme: Scheme) -> float | None:
    """Return by which power of the step the error falls; None if it is rounding, or fails."""
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
    """Return ours at the level's own rate, with the cheapest solver; None if none comes through."""
    here = [p for p in sweep.points if p.scheme == OURS and p.rate == sweep.own_rate]
    return min(
        (p for p in here if isfinite(p.error)), key=lambda p: p.seconds_per_second, default=None
    )


def next_digit(sweep: Sweep) -> float | None:
    """Return how many times the cost of a level one more digit costs.

    That is the cheapest setting with a tenth of its error. None if its error is rounding, or no run
    of the sweep comes so close.
    """
    here = own(sweep)
    if here is None or here.error <= ROUNDING:
        return None
    cost = cost_to_reach((p for p in sweep.points if p.scheme != NAIVE), here.error / 10)
    return None if cost is None else cost / here.seconds_per_second


def failed(sweeps: Iterable[Sweep]) -> list[str]:
    """Return the levels that do not come through at their own rate."""
    return [s.level for s in sweeps if s.failure or (s.points and own(s) is None)]


def headline(sweep: Sweep) -> Headline | None:
    """Return how the sandbox compares with stock pymunk; None if either does not run."""
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
    """Return what an error costs, by the finest run's cost and the order if no run reaches it."""
    reached = cost_to_reach(points, error)
    if reached is not None:
        return reached
    finest = min(points, key=lambda p: p.error)
    power = order(points, finest.scheme) or 1.0
    return finest.seconds_per_second * (finest.error / error) ** (1 / max(power, 0.5))
