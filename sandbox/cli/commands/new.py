"""The command `new`."""

from typing import Annotated

import typer


def command(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME",
            help="What its file is called, with or without .json.",
            show_default=False,
        ),
    ],
    template: Annotated[
        str,
        typer.Option(
            "--from",
            metavar="TEMPLATE",
            help="What it begins with: empty, falling, slope, pulley, pendulum, collision, orbit,"
            " challenge, or any level.",
        ),
    ] = "empty",
) -> None:
    """Write a new level that runs, as a start for your own.

    No file is ever overwritten.
    """
    from sandbox.cli.new import new

    new(name, template)
