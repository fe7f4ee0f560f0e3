"""`check`: whether levels are well formed, and can start and run at their rate."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import typer

from sandbox.cli.usage import levels, open_level
from sandbox.model import catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.remarks import remarks
from sandbox.model.schemes import bounds_the_rate

FEW = 30
"""Joints that are never too many for a step."""

PAUSE = 0.2
"""s, between two looks at the files that are watched."""


def keep_checking(arguments: Sequence[str]) -> NoReturn:
    """Check levels, and anew whenever one of their files changes, until the process is ended.

    Raises
    ------
    LevelError
        If there is no such level at the beginning; a file that goes later may come back.
    """
    paths = [catalog.find(argument) for argument in arguments]
    stamps = list(map(_stamp, paths))
    check(arguments)
    while True:
        time.sleep(PAUSE)
        found = list(map(_stamp, paths))
        if found == stamps:
            continue
        changed = [a for a, old, new in zip(arguments, stamps, found, strict=True) if old != new]
        stamps = found  # what changes while it is checked is checked once more
        typer.echo(f"\n{', '.join(changed)} at {time.strftime('%H:%M:%S')}:")
        check(arguments)


def _stamp(path: Path) -> tuple[int, int] | None:
    """Return when a file was written and how long it is; None if it is not there."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size


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
