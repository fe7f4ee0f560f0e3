"""The command `new`."""

from typing import Annotated

import typer

from sandbox.cli.commands.options import argument


def command(
    name: Annotated[str, argument("NAME", "The name of its file, with or without .json.")],
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
