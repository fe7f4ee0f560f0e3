"""The command `format`."""

from typing import Annotated

import typer


def command(
    levels: Annotated[
        list[str],
        typer.Argument(
            metavar="LEVEL", help="Names of levels, or paths of files.", show_default=False
        ),
    ],
    check: Annotated[
        bool, typer.Option("--check", help="Only say which levels would change; 1 if any would.")
    ] = False,
) -> None:
    """Lay the text of levels out as people write them by hand.

    Only spaces, line breaks and the order of the outermost keys change: numbers and formulas stay
    as they were typed. A level that has its lines where a person put them stays as it is.
    """
    from sandbox.cli.format import format_levels

    raise typer.Exit(format_levels(levels, write=not check))
