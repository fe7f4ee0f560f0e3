"""The command `migrate`."""

from typing import Annotated

import typer


def command(
    levels: Annotated[
        list[str],
        typer.Argument(
            metavar="LEVEL", help="Names of levels, or paths of files.", show_default=False
        ),
    ],
) -> None:
    """Convert levels to the newest version of the format.

    So far there is only one version: the command says which levels have it, and writes nothing.
    """
    from sandbox.cli.migrate import migrate

    raise typer.Exit(migrate(levels))
