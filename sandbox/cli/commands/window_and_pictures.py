"""The commands that open the window, or draw."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import (
    AccuracyOption,
    FirstPictureOption,
    LevelArgument,
    RaceOption,
    SetOption,
    WithOption,
    WithoutOption,
    argument,
    option,
)


@contextmanager
def uncollected() -> Iterator[None]:
    """Collect no garbage up to the first picture, as there is hardly any before.

    Then `Window.preload` collects it, and from there on it is collected as usual.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def play(
    level: LevelArgument,
    set_: SetOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
    first_picture: FirstPictureOption = False,
) -> None:
    """Open a level in the window."""
    searching = accuracy is not None  # then many worlds are made and lost before the window opens
    with nullcontext() if searching else uncollected():
        from sandbox.cli.play import play

        play(level, set_ or [], accuracy, racing=race, once=first_picture)


def render(
    level: LevelArgument,
    output: Annotated[Path, option("FILE.png", "The file to write.")],
    set_: SetOption = None,
    at: Annotated[float | None, option("S", "The time to show, in seconds.")] = None,
    without: WithoutOption = None,
    with_: WithOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
) -> None:
    """Draw a level as a PNG picture, without a window.

    With --without or --with, the changed run is drawn over the unchanged one, which is dashed.
    """
    from sandbox.cli.render import render

    render(level, output, set_ or [], at, without or [], with_ or [], accuracy, racing=race)


def tour(
    output: Annotated[Path, option("DIR", "The folder for the results; made if missing.")],
) -> None:
    """Run, check and draw every level, without a window.

    The folder receives a picture of each level, and an index.html that shows them all with what
    their checks found. The exit status is 1 if any level or check failed.
    """
    from sandbox.cli.tour import tour

    raise typer.Exit(tour(output))


def bench(
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
