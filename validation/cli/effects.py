"""The command `effects`."""

from typing import Annotated

import typer

from validation.cli.options import JsonFile


def command(
    json_file: JsonFile = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Fewer repetitions, and fewer bodies.")
    ] = False,
) -> None:
    """Measure the cost of each level beside the bare engine, and of each effect on many bodies."""
    from validation.effects.command import measure  # what one command needs need not slow all

    measure(json_file, quick=quick)
