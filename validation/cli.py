"""The commands of `python -m validation`.

Each declares its arguments and its help, and returns whether all is well. What only one of them
needs is imported when it is called, so that it slows none of the others.
"""

from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import Annotated, ParamSpec

import typer

from sandbox import interrupts
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import check_writable
from sandbox.model.errors import MisuseError, SandboxError, brief
from sandbox.optional_packages import needed_for
from validation import case_suite, output
from validation.case import Case
from validation.cases import all_cases

JsonFile = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Also write the outcome to this file.")
]

Jobs = Annotated[
    int | None,
    typer.Option(
        "--jobs", min=1, metavar="N", help="The number of processes; one per core if left out."
    ),
]

Given = ParamSpec("Given")

app = typer.Typer(
    name="validation",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


@app.callback()
def validation() -> None:
    """Validate the sandbox against the textbook, case by case, beside stock pymunk."""


def command(function: Callable[Given, bool | None]) -> Callable[Given, bool | None]:
    """Register a command, in the order of the help.

    It exits with 1 if it returns false, and tells errors like `sandbox`. A `json_file` that could
    not be written is refused before anything is measured.
    """

    @app.command(function.__name__)
    @wraps(function)
    def status(*given: Given.args, **options: Given.kwargs) -> None:
        try:
            if isinstance(file := options.get("json_file"), Path):
                check_writable(file)
            passed = function(*given, **options)
        except SandboxError as error:
            interrupts.insist()
            typer.echo(error, err=True)
            raise typer.Exit(error.exit_status) from None
        if passed is False:
            raise typer.Exit(1)

    return function


@command
def run(
    levels: Annotated[
        list[str] | None,
        typer.Argument(metavar="[LEVEL]...", help="Only the cases of these levels."),
    ] = None,
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> bool:
    """Compare every case with its closed form, beside stock pymunk.

    Exit status 1 if a case misses its bound, or if stock pymunk meets one that it should miss.
    """
    cases = of_levels(levels or [])
    outcomes = case_suite.outcomes(cases, jobs)
    with output.written(output.content(cases=outcomes), json_file):
        output.show(case_suite.table(cases, outcomes))
    failed = [
        case_suite.named(case) for case, o in zip(cases, outcomes, strict=True) if not o.passed
    ]
    output.complain(failed)
    typer.echo(f"{len(cases) - len(failed)} of {len(cases)} cases hold.")
    return not failed


def of_levels(names: Sequence[str]) -> list[Case]:
    """Return the cases of some levels, all cases if there are no names.

    Raises `SandboxError` if there is no such level, or no case is about it.
    """
    cases = list(all_cases())
    chosen = {level_catalog.find(name): name for name in names}
    found = [case for case in cases if not chosen or level_catalog.find(case.level) in chosen]
    for path in {level_catalog.find(case.level) for case in found}:
        chosen.pop(path, None)
    for name in chosen.values():
        raise MisuseError("{name}: no case is about this level", name=brief(name))
    return found


@command
def compose(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="The number of scenes.")
    ] = 200,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="The seed of the random scenes.")
    ] = 0,
    scenes: Annotated[
        list[int] | None,
        typer.Option("--scene", min=0, metavar="SEED", help="Only the scene with this seed."),
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write the levels that fail to this folder, so that they can be played.",
        ),
    ] = None,
    jobs: Jobs = None,
) -> bool:
    """Test random compositions of bodies, joints and effects for what must hold in any run.

    Exit status 1 if a test fails. A scene that is refused with a reason is not a failure.
    """
    with needed_for("a judgement of compositions"):
        from validation.random_compositions.command import measure
        from validation.random_compositions.seeded_scenes import seeds
    return measure(scenes or seeds(seed, count), json_file, output, jobs)


@command
def cost(
    levels: Annotated[
        list[str] | None,
        typer.Argument(metavar="[LEVEL]...", help="All levels if left out; a sixth with --quick."),
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Also draw a diagram for every level, in this folder."),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Fewer rates and shorter runs.")] = False,
) -> bool:
    """Show what accuracy costs in time: error against seconds for every scheme and rate.

    Exit status 1 if a level does not run at its own rate.
    """
    from validation.cost_of_accuracy.command import measure

    return not measure(levels or [], json_file, output, quick=quick)


@command
def requests(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="The number of requests.")
    ] = 100,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="The first of their seeds.")
    ] = 0,
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> bool:
    """Request accuracies of levels at random parameters, and check the errors that result.

    Exit status 1 if one is missed, or if an error is more than twice its estimate.
    """
    from validation.random_accuracy_requests import measure

    return measure(count, seed, json_file, jobs)


@command
def pace(
    levels: Annotated[
        list[str] | None, typer.Argument(metavar="[LEVEL]...", help="All levels if left out.")
    ] = None,
    json_file: JsonFile = None,
) -> bool:
    """Show the share of a core that each level needs to run in real time at its own rate.

    The share is given for this core at this moment, and for a reference core: a slow one that is
    idle. Exit status 1 if a level needs more than half of the reference core.
    """
    from validation.step_processor_time import measure

    return not measure(levels or [], json_file)


@command
def effects(
    json_file: JsonFile = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Fewer repetitions, and fewer bodies.")
    ] = False,
) -> None:
    """Measure the cost of each level beside the bare engine, and of each effect on many bodies."""
    from validation.effect_costs.command import measure

    measure(json_file, quick=quick)


@command
def report(
    output: Annotated[Path, typer.Option(metavar="DIR", help="The folder for report.html.")],
    source: Annotated[
        Path | None,
        typer.Option(
            "--from", metavar="DIR", help="Read the JSON files of other commands from this folder."
        ),
    ] = None,
    figures: Annotated[
        bool, typer.Option("--figures", help="Also write each diagram as PNG and SVG.")
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="A few cases and levels, and short runs.")
    ] = False,
) -> bool:
    """Write the whole validation as one self-contained HTML page.

    Exit status 1 if a part could not be measured or a case does not hold.
    """
    with needed_for("a report"):
        from validation.report.command import write
    return write(output, source, quick=quick, figures=figures)


@command
def stability(
    json_file: JsonFile = None,
    quick: Annotated[
        bool,
        typer.Option("--quick", help="Shorter runs; only check whether the frontiers still hold."),
    ] = False,
    update: Annotated[bool, typer.Option("--update", help="Record the present frontiers.")] = False,
) -> bool:
    """Run the hard cases, and make them harder until they break, beside pymunk at the same cost.

    Exit status 1 if a case misses its bound, or a frontier has moved inward.
    """
    from validation.stability.command import measure

    return not measure(json_file, quick=quick, update=update and not quick)


@command
def fuzz(
    count: Annotated[
        int | None,
        typer.Option(
            min=1,
            metavar="N",
            help="The number of levels, not counting repaired versions of those that are refused."
            " [default: 1000]",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(metavar="S", help="The seed of the random levels.")] = 0,
    minutes: Annotated[
        float | None,
        typer.Option(
            min=0,
            metavar="M",
            help="The time limit, in minutes; without N, as many levels as it allows.",
        ),
    ] = None,
    json_file: JsonFile = None,
    samples: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="The folder for levels that go wrong. [default: out/fuzz]"
        ),
    ] = None,
) -> bool:
    """Try levels that nobody would write, drawn from the schema or made from existing ones.

    If Atheris is installed, it guides the search to levels that reach more of the code. Each level
    must be answered within two seconds of computing and 500 MB. A level that goes wrong is shrunk
    as far as possible, and kept. Exit status 1 if there was one.
    """
    from validation.fuzz import command

    number = count or (None if minutes is not None else 1000)
    return command.fuzz(number, seed, minutes, json_file, samples or command.SAMPLES)
