"""The command `simulate`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import (
    AccuracyOption,
    DurationOption,
    IterationsOption,
    LevelArgument,
    RateOption,
    RecordOption,
    SchemeOption,
    SetOption,
    SolverOption,
    WithOption,
    WithoutOption,
    option,
)


def command(
    level: LevelArgument,
    output: Annotated[Path, option("FILE.csv", "The file to write.")],
    set_: SetOption = None,
    duration: DurationOption = None,
    rate: RateOption = None,
    scheme: SchemeOption = None,
    iterations: IterationsOption = None,
    solver: SolverOption = None,
    accuracy: AccuracyOption = None,
    record: RecordOption = None,
    without: WithoutOption = None,
    with_: WithOption = None,
) -> None:
    """Run a level and write it as a CSV file.

    No window opens. The comments at the top of the file say all that is needed to repeat the run.
    The results of the level's checks are printed, and the exit status is 1 if one failed.

    With --without or --with, the changed run is written instead. The printed table then shows how
    it differs from the unchanged level, in the quantities of its checks and in computing time.
    """
    from sandbox.cli.accuracy_option import Choice
    from sandbox.cli.simulate import simulate

    raise typer.Exit(
        simulate(
            level,
            output,
            set_ or [],
            duration,
            Choice(rate, scheme, iterations, solver),
            record or [],
            without or [],
            with_ or [],
            accuracy,
        )
    )
