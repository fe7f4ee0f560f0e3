"""The command `requests`."""

from typing import Annotated

import typer

from validation.cli.options import Jobs, JsonFile


def command(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="The number of requests.")
    ] = 100,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="The first of their seeds.")
    ] = 0,
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> bool:
    """Request accuracies of levels at random parameters, and check the errors that result.

    Exit status 1 if one is missed, or if an error is more than twice its estimate.
    """
    from validation.requests.command import measure  # what one command needs need not slow all

    return measure(count, seed, json_file, jobs)
