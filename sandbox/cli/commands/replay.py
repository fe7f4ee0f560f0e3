"""The command `replay`."""

from pathlib import Path
from typing import Annotated

import typer


def command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="The saved run.", show_default=False)
    ],
) -> None:
    """Repeat a run that was saved in the window, without a window.

    The level, the parameters and all actions are the same, each action at its own step. The exit
    status is 1 if a single bit of the final state differs.
    """
    from sandbox.cli.replay import replay

    raise typer.Exit(replay(file))
