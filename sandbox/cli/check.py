"""`check`: whether levels are well formed, and can start and run at their rate."""

from collections.abc import Sequence

import typer

from sandbox.cli.usage import levels, open_level
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.remarks import remarks
from sandbox.model.schemes import bounds_the_rate


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
    """Refuse a level whose rate is too low for it, or in which bodies overlap at the start.

    Only where either could be, the engine is needed.
    """
    contact = level.effects.contact
    if bounds_the_rate(level) or (contact and not contact.overlaps):
        from sandbox.physics.advising.preflight import refusal

        if error := refusal(level, advised=True):
            raise error
