"""The command `frames`."""

from pathlib import Path
from typing import Annotated

import typer


def command(
    levels: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[LEVEL]...", help="Which levels; all if none is named.", show_default=False
        ),
    ] = None,
    size: Annotated[
        str, typer.Option(metavar="WIDTHxHEIGHT", help="Of the window, in pixels.")
    ] = "1280x800",
    seconds: Annotated[
        float, typer.Option(metavar="S", help="How long each level plays.", min=0.1, max=600)
    ] = 2.0,
    json_: Annotated[
        Path | None,
        typer.Option("--json", metavar="FILE", help="Write it as JSON, too.", show_default=False),
    ] = None,
) -> None:
    """Show how long the window's frames take, level by level.

    Each level plays in a window that nobody sees, with its graph and the forces on a body in sight.
    A second of it is what the window computes for one beside drawing: to run it and to observe it.
    A level is smooth if 99 of 100 frames take less than 16.7 ms of one processor. The exit status
    is 1 if one that runs in real time is not.
    """
    from sandbox.cli.frames import measure

    raise typer.Exit(measure(levels or [], size, seconds, json_))
