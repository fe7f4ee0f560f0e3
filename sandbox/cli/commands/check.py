"""The command `check`."""

import os
from typing import Annotated

import typer

from sandbox.cli.commands.options import LevelsArgument

SHARE = 10
"""How many levels justify one more process, which takes half a second to start."""


def command(
    levels: LevelsArgument,
    watch: Annotated[
        bool, typer.Option("--watch", help="Check again whenever a file changes, until Ctrl-C.")
    ] = False,
) -> None:
    """Check whether levels are well formed.

    Every mistake is shown with its file, line and column, its path inside the level, the rule that
    it breaks, and a suggestion if possible. Springs and drags that are too strong for the level's
    rate are mistakes, too. Nothing is run.
    """
    from sandbox.processes import prepare  # what one command needs need not slow all

    jobs = min(os.cpu_count() or 1, len(levels) // SHARE) or 1
    if jobs > 1:
        prepare("sandbox.cli.check", "sandbox.physics.advising.preflight")
    from sandbox.cli.check import check, keep_checking

    if watch:
        keep_checking(levels, jobs)
    raise typer.Exit(check(levels, jobs))
