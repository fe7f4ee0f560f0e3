"""The report of a sweep, as JSON and as a table.

It has orders, the best points, and the comparison with stock pymunk.
"""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from math import inf, isfinite

import numpy as np
from rich.table import Table

from sandbox.model.level import Scheme
from validation import output
from validation.cost_of_accuracy.scheme_and_rate_sweep import NAIVE, OURS, Point, Sweep

TARGETS = (1e-2, 1e-3, 1e-4, 1e-6, 1e-9)

ROUNDING = 1e-11
"""The error below which it is rounding, and shows no order."""

LARGE = 0.1
"""The error above which it is too large to show an order."""

SAME = 1.2
"""The ratio of two costs below which they count as equal."""

LEAST = 1e-16
"""The substitute for an error of zero: the precision of a float."""

HEADINGS = (
    "order", "error", "cost", "pymunk, same time", "closer", "cheaper", "to 1e-3", "to 1e-6",
    "to 1e-9",
)  # fmt: skip

PUBLISHED = {"cost": "price"}
"""Fields of a request with another name in the JSON."""


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


def as_json(sweep: Sweep) -> dict[str, object]:
    """Return a sweep as content of the JSON file."""
    ours = [p for p in sweep.points if p.scheme != NAIVE]
    naive = [p for p in sweep.points if p.scheme == NAIVE]
    found, schemes = headline(sweep), dict.fromkeys(point.scheme for point in sweep.points)
    return {
        "level": sweep.level,
        "judged_by": sweep.judged_by,
        "failure": sweep.failure,
        "quantities": sweep.quantities,
        "own_rate": sweep.own_rate,
        "points": sweep.points,
        "order": order(sweep.points, OURS),
        "orders": {scheme: order(sweep.points, scheme) for scheme in schemes},
        "pareto": pareto(sweep.points),
        "to_reach": {f"{target:g}": cost_to_reach(ours, target) for target in TARGETS},
        "naive_to_reach": {f"{target:g}": cost_to_reach(naive, target) for target in TARGETS},
        "headline": found,
        "trusted": [{**asdict(trust), "digits": trust.digits} for trust in sweep.trusted],
        "next_digit": next_digit(sweep),
    }


def table(sweeps: Sequence[Sweep]) -> Table:
    """Return the costs of each level's accuracy as a table for the terminal."""
    found = output.table("What accuracy costs", "level", HEADINGS)
    for sweep in sweeps:
        found.add_row(sweep.level, *_cells(sweep))
    return found


def _cells(sweep: Sweep) -> list[str]:
    here, best = own(sweep), headline(sweep)
    if here is None:
        return [sweep.failure or ("does not run" if sweep.points else sweep.judged_by)]
    beside = best and (f"{best.naive_error:.1e}", times(best.closer), times(best.cheaper))
    ours = [p for p in sweep.points if p.scheme != NAIVE]
    reached = (cost_to_reach(ours, target) for target in (1e-3, 1e-6, 1e-9))
    return [
        order_in_words(here.error, order(sweep.points, OURS)),
        f"{here.error:.1e}",
        milliseconds(here.seconds_per_second),
        *(beside or ("never", "", "")),
        *("–" if cost is None else milliseconds(cost) for cost in reached),
    ]


def order_in_words(error: float, power: float | None) -> str:
    """Return an order as text; `exact` if the error is rounding, a dash if too few runs show one.

    Rounding errors that grow with the number of steps show no order either.
    """
    if error <= ROUNDING and (power is None or power < 0):
        return "exact"
    return "–" if power is None else f"{power:.2f}"


def asked(sweeps: Sequence[Sweep]) -> list[dict[str, object]]:
    """Return all requests for an accuracy as JSON content.

    The cost of a second of simulated time is called `price` there, since scripts depend on it.
    """
    return [
        {
            **{PUBLISHED.get(key, key): value for key, value in asdict(request).items()},
            "stepping": request.stepping and request.stepping.model_dump(),
            "honoured": request.honoured,
        }
        for sweep in sweeps
        for request in sweep.requests
    ]


def asked_table(sweeps: Sequence[Sweep]) -> Table:
    """Return the requests for an accuracy, and their results, as a table."""
    headings = ("asked for", "delivered", "estimated", "setting", "cost", "cheapest", "")
    found = output.table("Accuracy as a request", "level", headings)
    for request in (request for sweep in sweeps for request in sweep.requests):
        s = request.stepping
        found.add_row(
            request.level,
            f"{request.target:.0e}",
            f"{request.delivered:.1e}",
            f"{request.estimated:.1e}",
            f"{s.scheme} {s.rate:g} Hz" if s else "none",
            milliseconds(request.cost),
            milliseconds(request.cheapest),
            output.mark(passed=request.honoured, beyond=request.beyond),
        )
    return found


def summed(sweeps: Sequence[Sweep]) -> str:
    """Return a line that says how many requests were honoured."""
    requests = [request for sweep in sweeps for request in sweep.requests]
    met = sum(request.honoured for request in requests)
    beyond = sum(request.beyond for request in requests)
    return (
        f"{met} of {len(requests)} requested accuracies were delivered; {beyond} were refused, and "
        "no run of the sweep reaches them either"
    )


def milliseconds(seconds: float) -> str:
    """Return a cost as milliseconds of computing per second of the scene."""
    return f"{two_digits(seconds * 1e3)} ms/s"


def times(ratio: float) -> str:
    """Return a ratio with its significant digits."""
    return f"{ratio:.1e}×" if ratio >= 1e4 else f"{two_digits(ratio)}×"


def two_digits(value: float) -> str:
    """Return a positive number with two digits, without a power of ten if it is large."""
    return f"{value:.2g}" if value < 99.5 else f"{float(f'{value:.2g}'):.0f}"
