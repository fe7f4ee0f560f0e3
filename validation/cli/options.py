"""Options, exit statuses and error messages that several commands share."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from sandbox.model.errors import SandboxError

JsonFile = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Also write the outcome to this file.")
]

Jobs = Annotated[
    int | None,
    typer.Option(
        "--jobs", min=1, metavar="N", help="The number of processes; one per core if left out."
    ),
]


FAILED = 1


@contextmanager
def reported_errors() -> Iterator[None]:
    """Print an error and exit with its status, as `sandbox` does."""
    try:
        yield
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(error.exit_status) from None
