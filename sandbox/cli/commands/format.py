"""The command `format`."""

from typing import Annotated

import typer

from sandbox.cli.commands.options import LevelsArgument


def command(
    levels: LevelsArgument,
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="Only list the levels that would change; exit with 1 if there are any."
        ),
    ] = False,
) -> None:
    """Format the text of levels as people write it by hand.

    Only spaces, line breaks and the order of the outermost keys change: numbers and formulas stay
    as they were typed. Line breaks that a person made are kept.
    """
    from sandbox.cli.format import format_levels

    raise typer.Exit(format_levels(levels, write=not check))
