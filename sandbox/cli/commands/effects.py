"""The command `effects`."""

from sandbox.cli.commands.options import LevelArgument, SetOption


def command(level: LevelArgument, set_: SetOption = None) -> None:
    """Switch each effect of a level off in turn, and rank them by what they change.

    Shown is the quantity, of the level's checks and of where its bodies are, that the effect
    changes most, and what the effect costs a step. An effect that changes nothing is named.
    """
    from sandbox.cli.effects import weigh

    weigh(level, set_ or [])
