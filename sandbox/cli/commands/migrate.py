"""The command `migrate`."""

import typer

from sandbox.cli.commands.options import LevelsArgument


def command(levels: LevelsArgument) -> None:
    """Convert levels to the newest version of the format.

    So far there is only one version: the command says which levels have it, and writes nothing.
    """
    from sandbox.cli.migrate import migrate

    raise typer.Exit(migrate(levels))
