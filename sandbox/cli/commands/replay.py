"""The command `replay`."""

from pathlib import Path
from typing import Annotated

import typer


def command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="A run that was saved.", show_default=False)
    ],
) -> None:
    """Take a run again that was saved in the window, without a window.

    It begins with the same level and parameters, and does what a hand did at the same steps. The
    exit status is 1 if it comes to another state, be it by one bit.
    """
    from sandbox.cli.replay import replay

    raise typer.Exit(replay(file))
