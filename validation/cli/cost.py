"""The command `cost`."""

from pathlib import Path
from typing import Annotated

import typer

from validation.cli.options import JsonFile


def command(
    levels: Annotated[
        list[str] | None,
        typer.Argument(metavar="[LEVEL]...", help="All levels if left out; a sixth with --quick."),
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Also draw a diagram for every level, in this folder."),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Fewer rates and shorter runs.")] = False,
) -> bool:
    """Show what accuracy costs in time: error against seconds for every scheme and rate.

    Exit status 1 if a level does not run at its own rate.
    """
    from validation.cost.command import measure  # what one command needs need not slow all

    return not measure(levels or [], json_file, output, quick=quick)
