"""`format`: level files, laid out as people write them by hand."""

from collections.abc import Sequence

import typer

from sandbox.cli.argument_parsing import levels
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.level_writing import formatted
from sandbox.model.loading import parse, read


def format_levels(arguments: Sequence[str], *, write: bool) -> int:
    """Format levels, or list those that would change, and return the exit status."""
    bad = changed = 0
    for argument in arguments:
        try:
            differs = _format(argument, write=write)
        except SandboxError as error:
            bad += 1
            typer.echo(error, err=True)
        else:
            changed += differs
            if differs:
                typer.echo(f"{argument}: {'laid out anew' if write else 'would change'}")
    count = levels(len(arguments))
    if bad:
        typer.echo(f"{bad} of {count} cannot be laid out", err=True)
    typer.echo(f"{changed} of {count} {'changed' if write else 'would change'}")
    return int(bad > 0 or (changed > 0 and not write))


def _format(argument: str, *, write: bool) -> bool:
    """Return whether the text of a level differs from its layout, and correct it if asked to."""
    path = level_catalog.find(argument)
    typed = read(path)
    parse(typed, str(path))
    proper = formatted(typed)
    if write and proper != typed:
        write_atomically(path, proper)
    return proper != typed
