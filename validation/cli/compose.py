"""The command `compose`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.optional_packages import needed_for
from validation.cli.options import Jobs, JsonFile


def command(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="The number of scenes.")
    ] = 200,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="The seed of the random scenes.")
    ] = 0,
    scenes: Annotated[
        list[int] | None,
        typer.Option("--scene", min=0, metavar="SEED", help="Only the scene with this seed."),
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write the levels that fail to this folder, so that they can be played.",
        ),
    ] = None,
    jobs: Jobs = None,
) -> bool:
    """Test random compositions of bodies, joints and effects for what must hold in any run.

    Exit status 1 if a test fails. A scene that is refused with a reason is not a failure.
    """
    with needed_for("a judgement of compositions"):
        from validation.compose.command import measure
        from validation.compose.scenes import seeds
    return measure(scenes or seeds(seed, count), json_file, output, jobs)
