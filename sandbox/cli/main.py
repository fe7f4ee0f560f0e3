"""The entry point of the command line: each error becomes a message and an exit status."""

import io
import sys

import typer

from sandbox.cli.commands import app
from sandbox.model.errors import SandboxError

FAILED, MISUSED = 1, 2


def main() -> None:
    """Run the command line and exit with its status.

    0: all is well, 1: a check or level failed, 2: wrong usage.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # not every terminal can spell m/s²
    try:
        app()
    except SandboxError as error:
        typer.echo(error, err=True)
        sys.exit(MISUSED if _is_misuse(error) else FAILED)


def _is_misuse(error: SandboxError) -> bool:
    """Whether an error is about the arguments, not about a level."""
    from sandbox.cli.argument_parsing import MISUSES

    return isinstance(error, MISUSES)
