"""The command `bench`."""

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
    """Show how long the window takes to begin, to change levels, and for each frame.

    The first picture is timed from the start of a program that plays the level, of two starts the
    quicker. The switch is timed in a window that shows another level, from the request to the first
    picture. Then the level plays in a window that nobody sees, with its graph and the forces on a
    body in sight. A second of it is what the window computes for one beside drawing: to run it and
    to observe it. Frames are in seconds of one processor.

    Marked with ! is a first picture after 1.5 s, a switch of more than 0.3 s, and a level that is
    not smooth: 99 of 100 frames have to take less than 16.7 ms. The exit status is 1 if a level
    that runs in real time is not smooth.
    """
    from sandbox.cli.bench import measure

    raise typer.Exit(measure(levels or [], size, seconds, json_))
