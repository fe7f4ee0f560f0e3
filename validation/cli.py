"""The commands of `python -m validation`."""

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from sandbox.model.errors import SandboxError
from sandbox.model.files import write_atomically
from validation.case import Outcome, run
from validation.cases import all_cases
from validation.environment import environment

app = typer.Typer(
    help="Hold the sandbox against the textbook.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

JsonFile = Annotated[
    Path | None, typer.Option("--json", help="Also write the outcome to this file.")
]


@app.callback()
def validation() -> None:
    """Hold the sandbox against the textbook: every case beside pymunk used as it comes."""


@app.command(name="run")
def run_cases(json_file: JsonFile = None) -> None:
    """Run every case against its closed form, beside pymunk used naively.

    Exit status 1 if a case misses its bound, or if naive pymunk meets one that it should miss.
    """
    cases = list(all_cases())
    progress = Console(stderr=True)
    outcomes = list(
        track(
            run(cases),
            "Running cases",
            total=len(cases),
            console=progress,
            transient=True,
            disable=not progress.is_terminal,
        )
    )
    _show(outcomes)
    if json_file:
        _write(json_file, outcomes)
    if not all(outcome.passed for outcome in outcomes):
        raise typer.Exit(1)


def _show(outcomes: list[Outcome]) -> None:
    console = Console()
    if not console.is_terminal:
        console.width = 150  # a pipe or a log has room for whole names
    table = Table(title="Closed forms against runs", header_style="bold", row_styles=("", "dim"))
    for heading in (
        "case",
        "measured",
        "expected",
        "error",
        "bound",
        "naive error",
        "step",
        "naive",
    ):
        table.add_column(
            heading, justify="left" if heading == "case" else "right", no_wrap=heading != "case"
        )
    table.add_column("")
    for outcome in outcomes:
        table.add_row(
            outcome.name,
            f"{outcome.measured:.7g} {outcome.unit}",
            f"{outcome.expected:.7g}",
            f"{outcome.error:.1e}",
            f"{outcome.tolerance:.0e}",
            f"{outcome.naive_error:.1e}",
            f"{outcome.step_seconds * 1e6:.1f} µs",
            f"{outcome.naive_step_seconds * 1e6:.1f} µs",
            "[green]✓[/]" if outcome.passed else "[red]✗[/]",
        )
    console.print(table)
    failed = [outcome for outcome in outcomes if not outcome.passed]
    for outcome in failed:
        values = ", ".join(f"{name}={value:g}" for name, value in outcome.parameters.items())
        console.print(f"[red]failed:[/] {outcome.name} ({outcome.level}; {values})")
    console.print(f"{len(outcomes) - len(failed)} of {len(outcomes)} cases hold.")


def _write(path: Path, outcomes: list[Outcome]) -> None:
    """Write the outcome as JSON, which has no infinity and no NaN: such figures are null."""
    cases = [
        {
            name: None if isinstance(value, float) and not math.isfinite(value) else value
            for name, value in asdict(outcome).items()
        }
        for outcome in outcomes
    ]
    content = {"environment": environment(), "cases": cases}
    try:
        write_atomically(path, json.dumps(content, indent=2, ensure_ascii=False) + "\n")
    except SandboxError as error:
        Console(stderr=True).print(str(error), style="red", markup=False, highlight=False)
        raise typer.Exit(2) from None
