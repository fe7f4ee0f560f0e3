"""The report of a sweep, as JSON and as a table."""

from collections.abc import Sequence
from dataclasses import asdict

from rich.table import Table

from validation import output
from validation.cost.summary import (
    ROUNDING,
    TARGETS,
    cost_to_reach,
    headline,
    next_digit,
    order,
    own,
    pareto,
)
from validation.cost.sweep import NAIVE, OURS, Sweep

HEADINGS = (
    "order",
    "error",
    "cost",
    "pymunk, same time",
    "closer",
    "cheaper",
    "to 1e-3",
    "to 1e-6",
    "to 1e-9",
)


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


PUBLISHED = {"cost": "price"}
"""Fields of a request with another name in the JSON."""


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
