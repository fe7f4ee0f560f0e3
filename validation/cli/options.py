"""Options that several commands share, and what becomes of their results and errors."""

from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

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


class Commands(TyperGroup):
    """Commands that return whether all went well, or raise an error that is fit to be printed.

    Exit status 1 if not all went well, or if a level failed; 2 for wrong usage.
    """

    def invoke(self, ctx: Any) -> None:  # noqa: ANN401 (click's context is not typer's)
        """Run the command, and exit with its status."""
        try:
            status = 0 if super().invoke(ctx) else FAILED
        except SandboxError as error:
            typer.echo(error, err=True)
            status = FAILED if isinstance(error, LevelError | SimulationError) else MISUSED
        raise typer.Exit(status)
