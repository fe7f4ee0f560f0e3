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
    """Bring levels into the newest version of the format.

    There is one version so far, so nothing is written: what is told is which levels have it.
    """
    from sandbox.cli.migrate import migrate

    raise typer.Exit(migrate(levels))
