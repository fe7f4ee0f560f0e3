"""The command `render`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import (
    AccuracyOption,
    LevelArgument,
    RaceOption,
    SetOption,
    WithOption,
    WithoutOption,
)


def command(
    level: LevelArgument,
    output: Annotated[
        Path,
        typer.Option(metavar="FILE.png", help="The file to write.", show_default=False),
    ],
    set_: SetOption = None,
    at: Annotated[
        float | None,
        typer.Option(metavar="S", help="The time to show, in seconds.", show_default=False),
    ] = None,
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
