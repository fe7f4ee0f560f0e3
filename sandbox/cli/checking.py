"""`check`: whether levels are well formed."""

from collections.abc import Sequence

import typer

from sandbox.cli.usage import levels, open_level
from sandbox.model.errors import LevelError


def check(arguments: Sequence[str]) -> int:
    """Say every mistake of every level, and return the exit status."""
    bad = 0
    for argument in arguments:
        try:
            open_level(argument)
        except LevelError as error:
            bad += 1
            typer.echo(error, err=True)
    count = len(arguments)
    if bad:
        typer.echo(f"{bad} of {levels(count)} cannot be used", err=True)
        return 1
    typer.echo(f"{levels(count)} well formed")
    return 0
