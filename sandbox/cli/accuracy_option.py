"""`--accuracy`: the setting that reaches an accuracy is searched for and printed."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import typer
from pydantic import ValidationError

from sandbox.cli.argument_parsing import UsageError
from sandbox.model import parser_error_messages
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping


class Choice(NamedTuple):
    """Settings chosen on the command line; None for those of the level."""

    rate: float | None = None
    """Hz"""
    scheme: str | None = None
    iterations: int | None = None
    solver: str | None = None

    @property
    def given(self) -> dict[str, float | str]:
        """The chosen settings, by the names of their options."""
        return {name: value for name, value in self._asdict().items() if value is not None}


NOTHING = Choice()


def asking(level: Level, accuracy: float | None, choice: Choice = NOTHING) -> Level:
    """Return a level that asks for an accuracy, if one is given."""
    if accuracy is None:
        return level
    if choice.given:
        options = "".join(f" and --{name}" for name in choice.given)
        raise UsageError(f"--accuracy{options}: a setting is chosen or asked for, not both")
    return level.model_copy(update={"stepping": _stepping({"accuracy": accuracy})})


def settled(level: Level, values: Values, choice: Choice, also: Sequence[str] = ()) -> Stepping:
    """Return the stepping of a level: its own, with the changes from the command line."""
    if not choice.given:
        return find_out(level, values, also)
    own = level.stepping
    _stepping(choice.given)  # so that a mistake is reported for the options
    return _stepping({**own.at(own.rate).model_dump(), **choice.given})


FINDING = "Finding the cheapest setting ..."
"""What is shown during the search, before the run that it is about to take."""


def _stepping(settings: Mapping[str, float | str]) -> Stepping:
    try:
        return Stepping.model_validate(settings)
    except ValidationError as error:
        [name] = error.errors()[0]["loc"]
        value = settings[str(name)]
        shown = value if isinstance(value, str) else f"{value:g}"
        rule = parser_error_messages.rule(error.errors()[0])
        raise UsageError(f"--{name} {shown}: {rule}") from error


def find_out(level: Level, values: Values, also: Sequence[str] = ()) -> Stepping:
    """Return the stepping of a level; if it asks for an accuracy, print the search and its result.

    The accuracy is that of the motion, the checks, and other recorded quantities. Raises
    `AccuracyError` if it cannot be reached.
    """
    if level.stepping.accuracy is None:
        return level.stepping
    from rich.console import Console  # rarely needed

    from sandbox.physics.accuracy.calibration_cache import calibrated

    with Console(stderr=True).status(FINDING) as status:
        setting = calibrated(
            level,
            values,
            level.stepping.accuracy,
            tell=lambda why: typer.echo(why, err=True),
            also=also,
            progress=lambda _, now: status.update(f"{FINDING} {now}"),
        )
    typer.echo(setting)
    return setting.chosen.stepping
