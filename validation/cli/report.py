"""The command `report`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.optional_packages import needed_for


def command(
    output: Annotated[Path, typer.Option(metavar="DIR", help="The folder for report.html.")],
    source: Annotated[
        Path | None,
        typer.Option(
            "--from", metavar="DIR", help="Read the JSON files of other commands from this folder."
        ),
    ] = None,
    figures: Annotated[
        bool, typer.Option("--figures", help="Also write each diagram as PNG and SVG.")
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="A few cases and levels, and short runs.")
    ] = False,
) -> bool:
    """Write the whole validation as one self-contained HTML page.

    Exit status 1 if a part could not be measured or a case does not hold.
    """
    with needed_for("a report"):
        from validation.report.command import write
    return write(output, source, quick=quick, figures=figures)
