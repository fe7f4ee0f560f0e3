"""All cases together: run with progress, as a table, and as JSON."""

import os
from collections.abc import Iterator, Sequence
from functools import cache

from rich.table import Table

from sandbox import progress_bar
from sandbox.parallel_processes import spread
from validation import output
from validation.case import Case, Outcome, run, together
from validation.cases import all_cases

HEADINGS = ("measured", "expected", "error", "bound", "order", "naive error", "step", "naive")

WORTH = 8
"""The number of runs that justify another process."""


def outcomes(cases: Sequence[Case], jobs: int | None = None) -> list[Outcome]:
    """Run cases, with progress on a terminal, and return their outcomes in the same order.

    Worker processes look cases up by name in `all_cases`. A short list, run in this process, may
    contain others. By default there are as many processes as cores. Raises `SandboxError` if a
    level cannot be run.
    """
    found = dict(
        progress_bar.consume(
            _found(cases, jobs or os.cpu_count() or 1), "Running cases", len(cases)
        )
    )
    return [found[row] for row in range(len(cases))]


def _found(cases: Sequence[Case], jobs: int) -> Iterator[tuple[int, Outcome]]:
    """Yield outcomes as they finish, with the indices of their cases."""
    groups = together(cases)
    batches: Iterator[tuple[int, list[Outcome]]]
    if (jobs := min(jobs, len(groups) // WORTH)) > 1:
        names = [[(cases[row].level, named(cases[row])) for row in rows] for rows in groups]
        batches = spread(_run_by_name, names, jobs)
    else:
        batches = enumerate(list(run([cases[row] for row in rows])) for rows in groups)
    for group, batch in batches:
        yield from zip(groups[group], batch, strict=True)


def _run_by_name(names: Sequence[tuple[str, str]]) -> list[Outcome]:
    """Run cases in another process, by name, since formulas cannot be pickled."""
    known = _by_name()
    return list(run([known[name] for name in names]))


@cache
def _by_name() -> dict[tuple[str, str], Case]:
    return {(case.level, named(case)): case for case in all_cases()}


def named(case: Case) -> str:
    """Return a case's name with its parameters."""
    chosen = ", ".join(f"{name}={value:g}" for name, value in case.parameters.items())
    return f"{case.name} ({chosen})" if chosen else case.name


def table(cases: Sequence[Case], found: Sequence[Outcome]) -> Table:
    """Return a table with a row per case, for the terminal."""
    rows = output.table("Closed forms against runs", "case", HEADINGS)
    rows.add_column("")
    for case, outcome in zip(cases, found, strict=True):
        rows.add_row(
            named(case),
            f"{outcome.measured:.7g} {outcome.unit}",
            f"{outcome.expected:.7g}",
            f"{outcome.error:.1e}",
            f"{outcome.tolerance:.0e}",
            "" if outcome.order is None else f"{outcome.order:.2f}",
            f"{outcome.naive_error:.1e}",
            f"{outcome.step_seconds * 1e6:.1f} µs",
            f"{outcome.naive_step_seconds * 1e6:.1f} µs",
            output.mark(passed=outcome.passed),
        )
    return rows
