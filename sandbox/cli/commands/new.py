"""The command `new`."""

from typing import Annotated

import typer


def command(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME",
            help="The name of its file, with or without .json.",
            show_default=False,
        ),
    ],
    template: Annotated[
        str,
        typer.Option(
            "--from",
            metavar="TEMPLATE",
            help="The template: empty, falling, slope, pulley, pendulum, collision, orbit,"
            " challenge, or any level.",
        ),
    ] = "empty",
) -> None:
    """Write a new level that runs, as a starting point for your own.

    An existing file is never overwritten.
    """
    from sandbox.cli.new import new

    new(name, template)
