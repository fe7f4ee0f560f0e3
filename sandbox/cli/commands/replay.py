"""The command `replay`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import argument


def command(file: Annotated[Path, argument("FILE", "The saved run.")]) -> None:
    """Repeat a run that was saved in the window, without a window.

    The level, the parameters and all actions are the same, each action at its own step. The exit
    status is 1 if a single bit of the final state differs.
    """
    from sandbox.cli.replay import replay

    raise typer.Exit(replay(file))
