"""`--accuracy`: a setting that is asked for, found out and told."""

import typer
from pydantic import ValidationError
from rich.console import Console

from sandbox.cli.usage import UsageError
from sandbox.model import wording
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping


def asking(level: Level, accuracy: float | None, rate: float | None = None) -> Level:
    """Return a level that asks for an accuracy, if one is given."""
    if accuracy is None:
        return level
    if rate is not None:
        raise UsageError("--accuracy and --rate: a setting is chosen or asked for, not both")
    try:
        stepping = Stepping(accuracy=accuracy)
    except ValidationError as error:
        rule = wording.rule(error.errors()[0], ("accuracy",))
        raise UsageError(f"--accuracy {accuracy:g}: {rule}") from error
    return level.model_copy(update={"stepping": stepping})


def find_out(level: Level, values: Values) -> Stepping:
    """Return how a level is run; where it asks for an accuracy, say what that takes.

    Raises
    ------
    AccuracyError
        If it cannot be had.
    """
    if level.stepping.accuracy is None:
        return level.stepping
    from sandbox.physics.accuracy import calibrated  # few need it

    with Console(stderr=True).status("Finding the cheapest setting ..."):
        setting = calibrated(
            level, values, level.stepping.accuracy, tell=lambda why: typer.echo(why, err=True)
        )
    typer.echo(setting)
    return setting.chosen.stepping
