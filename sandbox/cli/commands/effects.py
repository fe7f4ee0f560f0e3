"""The command `effects`."""

from sandbox.cli.commands.options import LevelArgument, SetOption


def command(level: LevelArgument, set_: SetOption = None) -> None:
    """Switch each effect of a level off in turn, and rank them by what they change.

    For each effect, the table shows which quantity it changes most, among those of the checks and
    the positions of the bodies, and what it costs in each step. Effects that change nothing are
    listed, too.
    """
    from sandbox.cli.effects import weigh

    weigh(level, set_ or [])
