"""The command `pace`."""

from typing import Annotated

import typer

from validation.cli.options import JsonFile


def command(
    levels: Annotated[
        list[str] | None, typer.Argument(metavar="[LEVEL]...", help="All levels if left out.")
    ] = None,
    json_file: JsonFile = None,
) -> bool:
    """Show the share of a core that each level needs to run in real time at its own rate.

    The share is given for this core at this moment, and for a reference core: a slow one that is
    idle. Exit status 1 if a level needs more than half of the reference core.
    """
    from validation.pace.command import measure  # what one command needs need not slow all

    return not measure(levels or [], json_file)
