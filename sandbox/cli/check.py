"""`check`: whether levels are well formed, and can run at their rate."""

import time
from collections.abc import Sequence
from typing import NoReturn

import typer

from sandbox.cli.argument_parsing import levels, open_level
from sandbox.model import catalog
from sandbox.model.errors import SandboxError
from sandbox.model.file_watching import PAUSE, Watch
from sandbox.model.level import Level
from sandbox.model.remarks import remarks
from sandbox.model.schemes import bounds_the_rate

FEW = 30
"""Joints that are never too many for a step."""


def keep_checking(arguments: Sequence[str]) -> NoReturn:
    """Check levels, and anew whenever one of their files changes, until the process is ended.

    Raises
    ------
    LevelError
        If there is no such level at the beginning; a file that goes later may come back.
    """
    paths = [catalog.find(argument) for argument in arguments]
    watch = Watch(paths)
    check(arguments)
    while True:
        time.sleep(PAUSE)
        changed = watch.changed()  # what changes while it is checked is checked once more
        if changed:
            names = (a for a, path in zip(arguments, paths, strict=True) if path in changed)
            typer.echo(f"\n{', '.join(names)} at {time.strftime('%H:%M:%S')}:")
            check(arguments)


def check(arguments: Sequence[str]) -> int:
    """Say every mistake, and what is declared for nothing, and return the exit status."""
    bad = 0
    for argument in arguments:
        try:
            _, level = open_level(argument)
            _check_start(level)
        except SandboxError as error:
            bad += 1
            typer.echo(error, err=True)
        else:
            for remark in remarks(level):
                place = ".".join(map(str, remark.path))
                typer.echo(f"{argument}: {place}: {remark.rule}", err=True)
    count = len(arguments)
    if bad:
        typer.echo(f"{bad} of {levels(count)} cannot be used", err=True)
        return 1
    typer.echo(f"{levels(count)} well formed")
    return 0


def _check_start(level: Level) -> None:
    """Refuse a level with too low a rate, with bodies that overlap, or too much for a step.

    Only where either could be, the engine is needed.
    """
    crowded = level.effects.contact or len(level.joints) > FEW
    if bounds_the_rate(level) or crowded:
        from sandbox.physics.advising.preflight import refusal

        if error := refusal(level, advised=True):
            raise error
