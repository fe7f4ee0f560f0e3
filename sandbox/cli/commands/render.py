"""The command `render`."""

from pathlib import Path
from typing import Annotated

from sandbox.cli.commands.options import (
    AccuracyOption,
    LevelArgument,
    RaceOption,
    SetOption,
    WithOption,
    WithoutOption,
    option,
)


def command(
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
