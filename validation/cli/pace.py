"""The command `pace`."""

from typing import Annotated

import typer

from validation.cli.options import FAILED, JsonFile, reported_errors


def command(
    levels: Annotated[
        list[str] | None, typer.Argument(metavar="[LEVEL]...", help="All levels if left out.")
    ] = None,
    json_file: JsonFile = None,
) -> None:
    """Show which share of a core each level needs to run in real time, at its own rate.

    Of this core here and now, and of a reference core: a slow one that is idle. Exit status 1 if a
    level needs more than half of that.
    """
    from validation.pace.command import measure  # what one command needs need not slow all

    with reported_errors():
        slow = measure(levels or [], json_file)
    if slow:
        raise typer.Exit(FAILED)
