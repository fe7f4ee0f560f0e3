"""The outcomes as tables and as JSON."""

import math
from collections.abc import Iterable, Iterator, Sequence

from rich.table import Table

from validation import output
from validation.stability.run_all_cases import Outcome

ENOUGH = 0.9
"""The share of group C that must stand at a cost below real time."""


def tables(outcomes: Sequence[Outcome]) -> Iterator[Table]:
    """Yield the table of the cases and that of the frontiers."""
    yield _cases([o for o in outcomes if o.frontier is None])
    yield _frontiers([o for o in outcomes if o.frontier is not None])


def _cases(outcomes: Iterable[Outcome]) -> Table:
    table = output.table("Hard cases", "case", ("group", "figure", "bound", "order", "cost", ""))
    for o in outcomes:
        table.add_row(
            o.name,
            o.group,
            number(o.figure),
            f"{o.bound:.2g}",
            "" if o.order is None else f"{o.order:.2f}",
            "" if math.isnan(o.cost) else f"{o.cost:.3f} s/s",
            output.mark(passed=o.passed, beyond=bool(o.beyond)),
        )
    return table


def _frontiers(outcomes: Iterable[Outcome]) -> Table:
    headings = ("here", "was", "pymunk, same cost", "further", "cost", "rate", "its rate", "")
    table = output.table("Frontiers: how hard until the bound breaks", "frontier", headings)
    for o in outcomes:
        assert o.frontier is not None
        table.add_row(
            f"{o.name} [{o.axis}]".replace("[", "\\["),
            f"{number(o.frontier)} {o.unit or ''}".strip(),
            "" if o.previous is None else number(o.previous),
            number(o.naive_frontier),
            further(o),
            f"{o.cost:.3f} s/s",
            "" if o.rate is None else f"{o.rate:,.0f} Hz",
            "" if o.naive_rate is None else f"{o.naive_rate:,.0f} Hz",
            output.mark(passed=o.passed, beyond=bool(o.beyond)),
        )
    return table


def number(value: float | None) -> str:
    """Return a figure with three digits."""
    if value is None:
        return ""
    return f"{value:,.0f}" if 100 <= abs(value) < 1e5 else f"{value:.3g}"


def further(o: Outcome) -> str:
    """Return the ratio of a frontier to pymunk's, in words."""
    if not o.frontier or o.naive_frontier is None:
        return ""
    return "pymunk never" if o.naive_frontier == 0 else f"{o.frontier / o.naive_frontier:.3g}×"


def standing(outcomes: Iterable[Outcome]) -> tuple[int, int]:
    """Return how many of group C stand at a cost below real time, and how many there are."""
    stand = [o.passed and (math.isnan(o.cost) or o.cost < 1) for o in outcomes if o.group == "C"]
    return sum(stand), len(stand)


def failures(outcomes: Sequence[Outcome]) -> list[str]:
    """Return the failures that are not known to be out of reach."""
    failed = [o.name for o in outcomes if not o.passed and not o.beyond]
    stand, many = standing(outcomes)
    if stand < ENOUGH * many:
        failed.append(f"only {stand} of {many} stand at a cost below real time")
    return failed


def out_of_reach(outcomes: Iterable[Outcome]) -> list[str]:
    """Return the cases that are out of reach, with figures and reasons."""
    said = []
    for o in outcomes:
        if o.beyond is None:
            continue
        if o.frontier is None and not o.passed:
            said.append(f"{o.name}: {number(o.figure)} of {o.bound:.2g}; {o.beyond}")
        elif o.frontier is not None and o.frontier < (o.naive_frontier or 0):
            said.append(
                f"{o.name}: {number(o.frontier)} here, {number(o.naive_frontier)} for pymunk; "
                f"{o.beyond}"
            )
    return said
