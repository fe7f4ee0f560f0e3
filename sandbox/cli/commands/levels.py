"""The commands about the files of levels."""

import os
from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import LevelArgument, LevelsArgument, SetOption, argument, option


def list_() -> None:
    """List the levels: their names, titles, effects and summaries.

    If the output is not a terminal, each level is one line, with tabs between the columns.
    """
    from sandbox.cli.list import show_levels

    show_levels()


def new(
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


SHARE = 10
"""How many levels justify one more process, which takes half a second to start."""


def check(
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
    from sandbox.parallel_processes import prepare  # what one command needs need not slow all

    jobs = min(os.cpu_count() or 1, len(levels) // SHARE) or 1
    if jobs > 1:
        prepare("sandbox.cli.check", "sandbox.physics.advising.preflight_faults")
    from sandbox.cli.check import check, keep_checking

    if watch:
        keep_checking(levels, jobs)
    raise typer.Exit(check(levels, jobs))


def format_(
    levels: LevelsArgument,
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="Only list the levels that would change; exit with 1 if there are any."
        ),
    ] = False,
) -> None:
    """Format the text of levels as people write it by hand.

    Only spaces, line breaks and the order of the outermost keys change: numbers and formulas stay
    as they were typed. Line breaks that a person made are kept.
    """
    from sandbox.cli.format import format_levels

    raise typer.Exit(format_levels(levels, write=not check))


def migrate(levels: LevelsArgument) -> None:
    """Convert levels to the newest version of the format.

    So far there is only one version: the command says which levels have it, and writes nothing.
    """
    from sandbox.cli.migrate import migrate

    raise typer.Exit(migrate(levels))


def describe(
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


def generate(
    kind: Annotated[str, argument("SCENE", "The kind of scene: gas, pile, chain or cluster.")],
    output: Annotated[Path, option("FILE.json", "The file to write.")],
    bodies: Annotated[
        int, typer.Option(metavar="N", help="The number of moving bodies.", show_default=True)
    ] = 1000,
) -> None:
    """Write a level with many bodies, to watch or to measure."""
    from sandbox.cli.generate import generate

    generate(kind, bodies, output)
