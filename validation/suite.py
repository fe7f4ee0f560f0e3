"""All cases together: run with progress, as a table, and as JSON."""

import math
from collections.abc import Sequence
from dataclasses import asdict

from rich.console import Console
from rich.progress import track
from rich.table import Table

from validation.case import Case, Outcome, run
from validation.environment import environment

HEADINGS = ("measured", "expected", "error", "bound", "order", "naive error", "step", "naive")


def outcomes(cases: Sequence[Case]) -> list[Outcome]:
    """Run cases, with progress on a terminal.

    Raises
    ------
    SandboxError
        If a level cannot be run.
    """
    console = Console(stderr=True)
    progress = track(
        run(cases),
        "Running cases",
        total=len(cases),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    return list(progress)


def named(case: Case) -> str:
    """Return a case's name with what was chosen for it."""
    chosen = ", ".join(f"{name}={value:g}" for name, value in case.parameters.items())
    return f"{case.name} ({chosen})" if chosen else case.name


def table(cases: Sequence[Case], found: Sequence[Outcome]) -> Table:
    """Return a row a case, for the terminal."""
    rows = Table(title="Closed forms against runs", header_style="bold", row_styles=("", "dim"))
    rows.add_column("case")
    for heading in HEADINGS:
        rows.add_column(heading, justify="right", no_wrap=True)
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
            "[green]✓[/]" if outcome.passed else "[red]✗[/]",
        )
    return rows


def content(found: Sequence[Outcome]) -> dict[str, object]:
    """Return the outcomes as JSON takes them, without infinities and NaN: such figures are null."""
    cases = [
        {
            name: None if isinstance(value, float) and not math.isfinite(value) else value
            for name, value in asdict(outcome).items()
        }
        for outcome in found
    ]
    return {"environment": environment(), "cases": cases}
