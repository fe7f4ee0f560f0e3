"""The command `describe`."""

from typing import Annotated

import typer

from sandbox.cli.commands.options import LevelArgument, SetOption


def command(
    level: LevelArgument,
    set_: SetOption = None,
    at: Annotated[float, typer.Option(metavar="S", help="The time to describe, in seconds.")] = 0.0,
    forces: Annotated[
        bool, typer.Option("--forces", help="Also list the forces on each body.")
    ] = False,
) -> None:
    """Describe the scene in words, for a terminal or a screen reader.

    The description lists the parameters, the position and motion of each body, the joints with
    their forces, the contacts, and the results of the checks.
    """
    from sandbox.cli.describe import describe

    describe(level, set_ or [], at, with_forces=forces)
