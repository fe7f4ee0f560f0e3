"""The command `tour`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import option


def command(
    output: Annotated[Path, option("DIR", "The folder for the results; made if missing.")],
) -> None:
    """Run, check and draw every level, without a window.

    The folder receives a picture of each level, and an index.html that shows them all with what
    their checks found. The exit status is 1 if any level or check failed.
    """
    from sandbox.cli.tour import tour

    raise typer.Exit(tour(output))
