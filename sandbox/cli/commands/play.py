"""The command `play`."""

import gc

from sandbox.cli.commands.options import (
    AccuracyOption,
    FirstPictureOption,
    LevelArgument,
    RaceOption,
    SetOption,
)


def command(
    level: LevelArgument,
    set_: SetOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
    first_picture: FirstPictureOption = False,
) -> None:
    """Open a level in the window."""
    if accuracy is None:  # else many worlds are made and lost before the window opens
        gc.disable()  # up to the first picture nothing is lost: `Window.look_through`
    from sandbox.cli.play import play

    try:
        play(level, set_ or [], accuracy, racing=race, once=first_picture)
    finally:
        gc.enable()
