"""The command `describe`."""

from typing import Annotated

import typer

from sandbox.cli.commands.options import LevelArgument, SetOption


def command(
    level: LevelArgument,
    set_: SetOption = None,
    at: Annotated[
        float, typer.Option(metavar="S", help="The time that is described, in seconds.")
    ] = 0.0,
    forces: Annotated[
        bool, typer.Option("--forces", help="Tell the forces on each body, too.")
    ] = False,
) -> None:
    """Say in words what is on the stage: for a terminal, or a screen reader.

    Told are the parameters, where each body is and how it moves, what ties bodies together and with
    which force, what touches, and how the checks stand.
    """
    from sandbox.cli.describe import describe

    describe(level, set_ or [], at, with_forces=forces)
