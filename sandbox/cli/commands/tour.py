"""The command `tour`."""

from pathlib import Path
from typing import Annotated

import typer


def command(
    output: Annotated[
        Path,
        typer.Option(
            metavar="DIR", help="The folder for the results; made if missing.", show_default=False
        ),
    ],
) -> None:
    """Run, check and draw every level, without a window.

    The folder receives a picture of each level, and an index.html that shows them all with what
    their checks found. The exit status is 1 if any level or check failed.
    """
    from sandbox.cli.tour import tour

    raise typer.Exit(tour(output))
