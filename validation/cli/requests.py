"""The command `requests`."""

from typing import Annotated

import typer

from validation.cli.options import FAILED, Jobs, JsonFile, reported_errors


def command(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="How many requests.")
    ] = 100,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="The first of their seeds.")
    ] = 0,
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> None:
    """Ask levels at random parameters for an accuracy, and hold what is delivered against it.

    Exit status 1 if one is not delivered, or told better than it is by more than 2 times.
    """
    from validation.requests.command import measure  # what one command needs need not slow all

    with reported_errors():
        passed = measure(count, seed, json_file, jobs)
    if not passed:
        raise typer.Exit(FAILED)
