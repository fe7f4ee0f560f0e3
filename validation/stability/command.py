"""`python -m validation stability`."""

import json
from pathlib import Path

import typer
from rich.console import Console
from rich.progress import track

from sandbox.model.files import check_writable, write_atomically
from validation.environment import environment
from validation.stability import history
from validation.stability.families import all_cases, all_frontiers
from validation.stability.report import as_json, failures, out_of_reach, standing, tables
from validation.stability.run import Outcome, outcomes


def measure(json_file: Path | None, *, quick: bool, update: bool) -> list[str]:
    """Run all hard cases, print the tables, write what was asked for, and return what failed.

    Raises
    ------
    SandboxError
        If the outcome cannot be written.
    """
    if json_file:
        check_writable(json_file)
    names = [c.name for c in all_cases()] + [f.name for f in all_frontiers()]
    console = Console(stderr=True)
    progress = track(
        outcomes(quick=quick),
        "Hard cases",
        total=len(names),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    found = sorted(progress, key=lambda outcome: names.index(outcome.name))
    for table in tables(found):
        Console(width=None if Console().is_terminal else 160).print(table)
    _tell(found)
    if json_file:
        content = {"environment": environment(), "cases": [as_json(outcome) for outcome in found]}
        write_atomically(json_file, json.dumps(content, indent=2, ensure_ascii=False) + "\n")
        typer.echo(f"Written to {json_file}.")
    if update:
        frontiers = {
            o.name: (o.frontier, o.naive_frontier or 0.0) for o in found if o.frontier is not None
        }
        history.update(frontiers)
        typer.echo(f"Frontiers written to {history.FILE}.")
    failed = failures(found)
    for name in failed:
        typer.echo(f"failed: {name}", err=True)
    return failed


def _tell(found: list[Outcome]) -> None:
    cases = [outcome for outcome in found if outcome.frontier is None]
    stand, many = standing(found)
    typer.echo(f"{sum(case.passed for case in cases)} of {len(cases)} cases hold.")
    typer.echo(f"{stand} of {many} that should stand do so at a cost below real time.")
    if beyond := out_of_reach(found):
        typer.echo("Out of reach:")
        for said in beyond:
            typer.echo(f"  {said}")
