"""The command `run`."""

from collections.abc import Sequence
from typing import Annotated

import typer

from sandbox.model import level_catalog
from sandbox.model.file_writing import check_writable
from validation import output, suite
from validation.case import Case
from validation.cases import all_cases
from validation.cli.options import Jobs, JsonFile


def command(
    levels: Annotated[
        list[str] | None,
        typer.Argument(metavar="[LEVEL]...", help="Only the cases of these levels."),
    ] = None,
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> bool:
    """Compare every case with its closed form, beside stock pymunk.

    Exit status 1 if a case misses its bound, or if stock pymunk meets one that it should miss.
    """
    if json_file:
        check_writable(json_file)
    cases = of_levels(levels or [])
    outcomes = suite.outcomes(cases, jobs)
    with output.written(suite.content(outcomes), json_file):
        output.show(suite.table(cases, outcomes))
    failed = [suite.named(case) for case, o in zip(cases, outcomes, strict=True) if not o.passed]
    output.complain(failed)
    typer.echo(f"{len(cases) - len(failed)} of {len(cases)} cases hold.")
    return not failed


def of_levels(names: Sequence[str]) -> list[Case]:
    """Return the cases of some levels, all cases if there are no names.

    Raises `SandboxError` if there is no such level.
    """
    chosen = {level_catalog.find(name) for name in names}
    return [case for case in all_cases() if not chosen or level_catalog.find(case.level) in chosen]
