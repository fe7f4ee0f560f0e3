"""The command `bench`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import argument, option


def command(
    levels: Annotated[
        list[str] | None, argument("[LEVEL]...", "The levels to measure; all if left out.")
    ] = None,
    size: Annotated[
        str, typer.Option(metavar="WIDTHxHEIGHT", help="The size of the window, in pixels.")
    ] = "1280x800",
    seconds: Annotated[
        float, typer.Option(metavar="S", help="How long each level plays.", min=0.1, max=600)
    ] = 2.0,
    json_: Annotated[
        Path | None, option("FILE", "Also write the result as JSON.", "--json")
    ] = None,
) -> None:
    """Measure how long the window takes to start, to change levels, and to draw each frame.

    The first picture is timed from the start of a program that plays the level; the faster of two
    starts counts. The switch is timed in a window that shows another level, from the request to the
    first picture. Then the level plays in an invisible window that shows its graph and the forces
    on a body. The time per second of the run is that of computing and observing it, without
    drawing. Frames are in seconds of one processor.

    A figure is marked with ! if the first picture takes more than 1.5 s, the switch more than
    0.3 s, or if the level is not smooth: 99 of 100 frames have to take less than 16.7 ms. The exit
    status is 1 if a level that runs in real time is not smooth.
    """
    from sandbox.cli.bench import measure

    raise typer.Exit(measure(levels or [], size, seconds, json_))
