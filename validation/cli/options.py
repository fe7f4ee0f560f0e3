"""Options, exit statuses and error messages that several commands share."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from sandbox.model.errors import LevelError, SandboxError
from sandbox.physics.state.errors import SimulationError

JsonFile = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Also write the outcome to this file.")
]

Jobs = Annotated[
    int | None,
    typer.Option(
        "--jobs", min=1, metavar="N", help="How many processes share them; all cores if left out."
    ),
]


FAILED, MISUSED = 1, 2


@contextmanager
def reported_errors() -> Iterator[None]:
    """Print an error and exit: with 1 if a level failed, with 2 for wrong usage."""
    try:
        yield
    except SandboxError as error:
        typer.echo(error, err=True)
        failed = isinstance(error, LevelError | SimulationError)
        raise typer.Exit(FAILED if failed else MISUSED) from None
