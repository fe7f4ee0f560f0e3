"""The entry point of the command line: each error becomes a message and an exit status."""

import sys

import typer

from sandbox import interrupts
from sandbox.cli.commands import app
from sandbox.model.errors import SandboxError


def main() -> None:
    """Run the command line and exit with its status.

    0: all is well, 1: a check, a level, or reading or writing a file failed, 2: wrong usage.
    """
    try:
        app()
    except SandboxError as error:
        interrupts.insist()
        typer.echo(error, err=True)
        sys.exit(error.exit_status)
