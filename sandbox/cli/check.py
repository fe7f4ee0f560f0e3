"""`check`: whether levels are well formed, and can run at their rate."""

import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple, NoReturn

import typer

from sandbox.cli.argument_parsing import levels, open_level
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.file_watching import PAUSE, Watch
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.remarks_on_valid_levels import remarks
from sandbox.model.scheme_requirements import bounds_the_rate
from sandbox.parallel_processes import spread


class Finding(NamedTuple):
    """A message about a level, and whether the level is unusable."""

    messages: list[str]
    refused: bool


def keep_checking(arguments: Sequence[str], jobs: int = 1) -> NoReturn:
    """Check levels whenever one of their files changes, until the process is ended.

    Processes share the levels the first time if there is more than one job. Raises `LevelError` if
    there is no such level at the beginning; a file that is deleted later may come back.
    """
    paths = [level_catalog.find(argument) for argument in arguments]
    watch = Watch(paths)
    check(arguments, jobs)
    while True:
        time.sleep(PAUSE)
        changed = watch.changed()  # a file that changes during its check is checked again
        if changed:
            names = (a for a, path in zip(arguments, paths, strict=True) if path in changed)
            typer.echo(f"\n{', '.join(names)} at {time.strftime('%H:%M:%S')}:")
            check(arguments)


def check(arguments: Sequence[str], jobs: int = 1) -> int:
    """Print every mistake and every remark, and return the exit status.

    Processes share the levels if there is more than one job.
    """
    bad = 0
    for finding in _findings(arguments, jobs):
        bad += finding.refused
        for message in finding.messages:
            typer.echo(message, err=True)
    count = len(arguments)
    if bad:
        typer.echo(f"{bad} of {levels(count)} cannot be used", err=True)
        return 1
    typer.echo(f"{levels(count)} well formed")
    return 0


def _findings(arguments: Sequence[str], jobs: int) -> Iterator[Finding]:
    """Yield the findings about each level, in their order."""
    if jobs == 1:
        yield from map(_finding, arguments)
        return
    early: dict[int, Finding] = {}  # finished before an earlier level
    due = 0
    for number, finding in spread(_finding, arguments, jobs):
        early[number] = finding
        while due in early:
            yield early.pop(due)
            due += 1


def _finding(argument: str) -> Finding:
    try:
        _, level = open_level(argument)
        _check_start(level)
    except SandboxError as error:
        return Finding([str(error)], refused=True)
    found = (*remarks(level), *_start_remarks(level))
    rules = ((".".join(map(str, remark.path)), remark.rule) for remark in found)
    return Finding([f"{argument}: {place}: {rule}" for place, rule in rules], refused=False)


def _start_remarks(level: Level) -> Iterator[Fault]:
    """Yield a remark if the joints change the velocities at the start.

    The engine is needed only for levels with joints and velocities.
    """
    moves = frozenset({"velocity", "angular_velocity"})
    if level.joints and any(moves & body.model_fields_set for body in level.bodies.values()):
        from sandbox.physics.advising.incompatible_start_velocities import unfit_start

        if found := unfit_start(level):
            yield found


def _check_start(level: Level) -> None:
    """Refuse too low a rate, overlapping bodies, redundant joints, or too expensive a step.

    The engine is needed only for levels where one of these is possible.
    """
    if bounds_the_rate(level) or level.effects.contact or len(level.joints) > 1:
        from sandbox.physics.advising.preflight_faults import refusal

        if error := refusal(level, advised=True):
            raise error
