"""Options, exit statuses and error messages that commands share."""

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Annotated, ParamSpec

import typer

from sandbox import interrupts
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

Given = ParamSpec("Given")


def with_status(command: Callable[Given, bool | None]) -> Callable[Given, None]:
    """Return a command that exits with 1 if it returns false, and tells errors like `sandbox`."""

    @wraps(command)
    def run(*given: Given.args, **options: Given.kwargs) -> None:
        try:
            passed = command(*given, **options)
        except SandboxError as error:
            interrupts.insist()
            typer.echo(error, err=True)
            raise typer.Exit(error.exit_status) from None
        if passed is False:
            raise typer.Exit(1)

    return run
