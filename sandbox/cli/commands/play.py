"""The command `play`."""

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
    from sandbox.cli.play import play

    play(level, set_ or [], accuracy, racing=race, once=first_picture)
