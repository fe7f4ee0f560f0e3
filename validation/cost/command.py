"""`python -m validation cost`."""

import json
from collections.abc import Sequence
from pathlib import Path

import typer
from rich.console import Console
from rich.progress import track

from sandbox.model import catalog
from sandbox.model.files import check_writable, write_atomically
from validation.cost.report import as_json, asked, asked_table, summed, table
from validation.cost.run import sweeps
from validation.cost.summary import headline
from validation.cost.sweep import QUICK, Budget, Sweep
from validation.environment import environment


def measure(
    names: Sequence[str], json_file: Path | None, output: Path | None, *, quick: bool
) -> list[str]:
    """Sweep levels, print the table, write what was asked for, and return the levels that failed.

    Raises
    ------
    SandboxError
        If there is no such level, or the outcome cannot be written.
    """
    if json_file:
        check_writable(json_file)
    for name in names:
        catalog.find(name)
    found = sweep_all(list(names) or catalog.textbook(), quick=quick)
    console = Console(width=None if Console().is_terminal else 160)
    console.print(table(found))
    if any(sweep.requests for sweep in found):
        console.print(asked_table(found))
        typer.echo(summed(found))
    if json_file:
        write_atomically(json_file, json.dumps(content(found), indent=2, ensure_ascii=False) + "\n")
        typer.echo(f"Written to {json_file}.")
    if output:
        from validation.cost.figure import draw  # matplotlib takes its time

        for sweep in found:
            draw(sweep, output)
        typer.echo(f"Drawn in {output}.")
    failed = [sweep.level for sweep in found if sweep.points and headline(sweep) is None]
    for name in failed:
        typer.echo(f"failed: {name}", err=True)
    return failed


def content(found: Sequence[Sweep]) -> dict[str, object]:
    """Return sweeps as the JSON file holds them."""
    return {
        "environment": environment(),
        "levels": [as_json(sweep) for sweep in found],
        "requests": asked(found),
    }


def sweep_all(names: Sequence[str], *, quick: bool) -> list[Sweep]:
    """Sweep levels, with progress on a terminal."""
    console = Console(stderr=True)
    progress = track(
        sweeps(names, QUICK if quick else Budget()),
        "Measuring what accuracy costs",
        total=len(names),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    return list(progress)
