"""The command `experiment`."""

from pathlib import Path
from typing import Annotated

from sandbox.cli.commands.options import (
    DurationOption,
    RateOption,
    SchemeOption,
    SetOption,
    argument,
    option,
)

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


def command(
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
    from sandbox.cli.experiment import Asked, experiment, fit

    others = {
        "until": until, "draws": draws, "method": method, "seed": seed,
        "duration": duration, "rate": rate, "scheme": scheme,
    }  # fmt: skip
    given = {name: value for name, value in others.items() if value is not None}
    asked = Asked(subject, vary or [], measure or [], set_ or [], given)
    if fit_ or data:
        fit(asked, fit_ or [], data, output)
    else:
        experiment(asked, output, jobs, cluster)
