"""`python -m validation stability`."""

from pathlib import Path

import typer

from sandbox import progress_bar
from validation import output
from validation.stability import frontier_history
from validation.stability.families import all_cases, all_frontiers
from validation.stability.report import failures, out_of_reach, standing, tables
from validation.stability.run_all_cases import Outcome, outcomes


def measure(json_file: Path | None, *, quick: bool, update: bool) -> list[str]:
    """Run all hard cases, print the tables, write the requested files, and return the failures.

    Raises `SandboxError` if the outcome cannot be written.
    """
    found = measured(quick=quick)
    with output.written(output.content(cases=found), json_file):
        output.show(*tables(found))
        _tell(found)
    if update:
        frontiers = {
            o.name: (o.frontier, o.naive_frontier or 0.0) for o in found if o.frontier is not None
        }
        frontier_history.update(frontiers)
        typer.echo(f"Frontiers written to {frontier_history.FILE}.")
    failed = failures(found)
    output.complain(failed)
    return failed


def measured(*, quick: bool) -> list[Outcome]:
    """Run all hard cases, and search for all frontiers."""
    names = [c.name for c in all_cases()] + [f.name for f in all_frontiers()]
    found = progress_bar.consume(outcomes(quick=quick), "Hard cases", len(names))
    return sorted(found, key=lambda outcome: names.index(outcome.name))


def _tell(found: list[Outcome]) -> None:
    cases = [outcome for outcome in found if outcome.frontier is None]
    stand, many = standing(found)
    typer.echo(f"{sum(case.passed for case in cases)} of {len(cases)} cases hold.")
    typer.echo(f"{stand} of {many} that should stand do so at a cost below real time.")
    if beyond := out_of_reach(found):
        typer.echo("Out of reach:")
        for said in beyond:
            typer.echo(f"  {said}")
