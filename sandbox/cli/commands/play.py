"""The command `play`."""

from sandbox.cli.commands.options import AccuracyOption, LevelArgument, RaceOption, SetOption


def command(
    level: LevelArgument,
    set_: SetOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
) -> None:
    """Open a level in the window."""
    from sandbox.cli.play import play

    play(level, set_ or [], accuracy, racing=race)
