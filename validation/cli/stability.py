"""The command `stability`."""

from typing import Annotated

import typer

from validation.cli.options import JsonFile


def command(
    json_file: JsonFile = None,
    quick: Annotated[
        bool,
        typer.Option("--quick", help="Shorter runs; only check whether the frontiers still hold."),
    ] = False,
    update: Annotated[bool, typer.Option("--update", help="Record the present frontiers.")] = False,
) -> bool:
    """Run the hard cases, and make them harder until they break, beside pymunk at the same cost.

    Exit status 1 if a case misses its bound, or a frontier has moved inward.
    """
    from validation.stability.command import measure  # what one command needs need not slow all

    return not measure(json_file, quick=quick, update=update and not quick)
