"""The command `fuzz`."""

from pathlib import Path
from typing import Annotated

import typer

from validation.cli.options import JsonFile


def command(
    count: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="The number of levels. [default: 1000]")
    ] = None,
    seed: Annotated[int, typer.Option(metavar="S", help="The seed of the random levels.")] = 0,
    minutes: Annotated[
        float | None,
        typer.Option(
            min=0,
            metavar="M",
            help="The time limit, in minutes; without N, as many levels as it allows.",
        ),
    ] = None,
    json_file: JsonFile = None,
    samples: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="The folder for levels that go wrong. [default: out/fuzz]"
        ),
    ] = None,
) -> bool:
    """Try levels that nobody would write, drawn from the schema or made from existing ones.

    If Atheris is installed, it guides the search to levels that reach more of the code. Each level
    must be answered within two seconds of computing and 500 MB. A level that goes wrong is shrunk
    as far as possible, and kept. Exit status 1 if there was one.
    """
    from validation.fuzz import command  # what one command needs need not slow all

    number = count or (None if minutes is not None else 1000)
    return command.fuzz(number, seed, minutes, json_file, samples or command.SAMPLES)
