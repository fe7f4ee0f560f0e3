"""The commands that run levels, and write what they measured."""

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
    argument,
    option,
)


def simulate(
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


def effects(level: LevelArgument, set_: SetOption = None) -> None:
    """Switch each effect of a level off in turn, and rank them by what they change.

    For each effect, the table shows which quantity it changes most, among those of the checks and
    the positions of the bodies, and what it costs in each step. Effects that change nothing are
    listed, too.
    """
    from sandbox.cli.effects import weigh

    weigh(level, set_ or [])


SubjectArgument = Annotated[
    str,
    argument(
        "LEVEL|EXPERIMENT",
        "A level, which the options vary and measure; or, without options, an experiment:"
        " the path of its file, or a name such as flip-map.",
    ),
]
OutputOption = Annotated[Path, option("DIR", "The folder for the results; made if missing.")]
VaryOption = Annotated[
    list[str] | None,
    option(
        "NAME=VALUES",
        "A parameter, 'without' (effects), 'scheme' or 'rate', and its values: a grid"
        " 0:90:91 or 1:1000:31:log, a list 1,2,5, or random draws 0..1 or 1.00±0.01. Can be"
        " repeated.",
    ),
]
MeasureOption = Annotated[
    list[str] | None,
    option(
        "MEASURE",
        "A measure of each run, such as ball.position.x@end, t@landing,"
        " ball.speed@apex, max(ball.speed) or error(range). Can be repeated.",
    ),
]
UntilOption = Annotated[
    str | None,
    option("CONDITION", "End each run as soon as this holds, such as 'ball.position.y < 0'."),
]
DrawsOption = Annotated[int | None, option("N", "The number of random draws.")]
MethodOption = Annotated[
    str | None,
    option("NAME", "The sampling method: random, latin-hypercube, sobol or sobol-indices."),
]
SeedOption = Annotated[int | None, option("N", "The seed of the random draws.")]
JobsOption = Annotated[int | None, option("N", "The number of processes. Default: one per core.")]
ClusterOption = Annotated[
    str | None,
    option("ADDRESS", "Run on the Dask cluster of this scheduler: tcp://127.0.0.1:8786."),
]
FitOption = Annotated[
    list[str] | None,
    option(
        "NAME",
        "Instead of an experiment, fit this parameter of the level to --data, with its"
        " uncertainty. Can be repeated.",
        "--fit",
    ),
]
DataOption = Annotated[
    Path | None,
    option(
        "FILE.csv",
        "Measured data: a column t [s], and columns named after quantities, such as"
        " bob.position.x; a column 'bob.position.x ±' has its standard uncertainties.",
    ),
]


def experiment(
    subject: SubjectArgument,
    output: OutputOption,
    vary: VaryOption = None,
    measure: MeasureOption = None,
    set_: SetOption = None,
    until: UntilOption = None,
    draws: DrawsOption = None,
    method: MethodOption = None,
    seed: SeedOption = None,
    duration: DurationOption = None,
    rate: RateOption = None,
    scheme: SchemeOption = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    fit_: FitOption = None,
    data: DataOption = None,
) -> None:
    """Run a level many times over a grid or random draws of its parameters, and measure each run.

    The folder receives results.parquet with a row for each run, report.html with the figures, and
    experiment.json, from which the experiment can be repeated. Give the same command again to
    resume an experiment that was interrupted.
    """
    from sandbox.cli.experiment import ExperimentRequest, experiment, fit

    others = {
        "until": until, "draws": draws, "method": method, "seed": seed,
        "duration": duration, "rate": rate, "scheme": scheme,
    }  # fmt: skip
    options = {name: value for name, value in others.items() if value is not None}
    request = ExperimentRequest(subject, vary or [], measure or [], set_ or [], options)
    if fit_ or data:
        fit(request, fit_ or [], data, output)
    else:
        experiment(request, output, jobs, cluster)


def replay(file: Annotated[Path, argument("FILE", "The saved run.")]) -> None:
    """Repeat a run that was saved in the window, without a window.

    The level, the parameters and all actions are the same, each action at its own step. The exit
    status is 1 if a single bit of the final state differs.
    """
    from sandbox.cli.replay import replay

    raise typer.Exit(replay(file))
