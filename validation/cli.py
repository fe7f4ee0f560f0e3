"""The commands of `python -m validation`."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from sandbox.extras import needed_for
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.files import check_writable
from sandbox.physics.state.errors import SimulationError
from validation import output, suite
from validation.cases import all_cases

app = typer.Typer(
    name="validation",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

JsonFile = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Also write the outcome to this file.")
]

Jobs = Annotated[
    int | None,
    typer.Option(
        "--jobs", min=1, metavar="N", help="How many processes share them; all cores if left out."
    ),
]


FAILED, MISUSED = 1, 2


@contextmanager
def _told() -> Iterator[None]:
    """Tell an error, and leave: with 1 if a level failed, with 2 for wrong usage."""
    try:
        yield
    except SandboxError as error:
        typer.echo(error, err=True)
        failed = isinstance(error, LevelError | SimulationError)
        raise typer.Exit(FAILED if failed else MISUSED) from None


@app.callback()
def validation() -> None:
    """Hold the sandbox against the textbook: every case beside pymunk used as it comes."""


@app.command(name="run")
def run_cases(
    json_file: JsonFile = None,
    jobs: Jobs = None,
) -> None:
    """Run every case against its closed form, beside pymunk used naively.

    Exit status 1 if a case misses its bound, or if naive pymunk meets one that it should miss.
    """
    with _told():
        if json_file:
            check_writable(json_file)
        cases = list(all_cases())
        outcomes = suite.outcomes(cases, jobs)
        output.show(suite.table(cases, outcomes))
        if json_file:
            output.write(suite.content(outcomes), json_file)
    failed = [suite.named(case) for case, o in zip(cases, outcomes, strict=True) if not o.passed]
    output.complain(failed)
    typer.echo(f"{len(cases) - len(failed)} of {len(cases)} cases hold.")
    if failed:
        raise typer.Exit(FAILED)


@app.command()
def compose(
    count: Annotated[
        int, typer.Option("--count", min=1, metavar="N", help="How many scenes.")
    ] = 200,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="S", help="What they are drawn from.")
    ] = 0,
    scenes: Annotated[
        list[int] | None,
        typer.Option("--scene", min=0, metavar="SEED", help="Only the scene with this own seed."),
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write levels that fail there, to be played.")
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Judge random compositions of bodies, joints and effects by what must hold in any run.

    Exit status 1 if a judgement fails. A scene that is refused with a reason is none.
    """
    with _told():
        measure = _composer()
        passed = measure(scenes or _seeds(seed, count), json_file, output, jobs)
    if not passed:
        raise typer.Exit(FAILED)


def _seeds(seed: int, count: int) -> list[int]:
    from validation.compose.scenes import seeds

    return seeds(seed, count)


def _composer() -> Callable[..., bool]:
    """Return what judges compositions, which needs a library that nothing else does."""
    with needed_for("a judgement of compositions"):
        from validation.compose.command import measure
    return measure


@app.command()
def cost(
    levels: Annotated[
        list[str] | None, typer.Argument(metavar="[LEVEL]...", help="All levels if left out.")
    ] = None,
    json_file: JsonFile = None,
    output: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Also draw a diagram for every level there.")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Fewer rates and shorter runs.")] = False,
) -> None:
    """Show what accuracy costs in time: error against seconds for every scheme and rate.

    Exit status 1 if a level does not run at its own rate.
    """
    from validation.cost.command import measure  # what one command needs need not slow all

    with _told():
        failed = measure(levels or [], json_file, output, quick=quick)
    if failed:
        raise typer.Exit(FAILED)


@app.command()
def effects(
    json_file: JsonFile = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Fewer repetitions, and fewer bodies.")
    ] = False,
) -> None:
    """Measure what each level pays beside the bare engine, and each effect over many bodies."""
    from validation.effects.command import measure  # what one command needs need not slow all

    with _told():
        measure(json_file, quick=quick)


@app.command()
def report(
    output: Annotated[Path, typer.Option(metavar="DIR", help="Where report.html goes.")],
    source: Annotated[
        Path | None,
        typer.Option("--from", metavar="DIR", help="Read the JSON of other commands found there."),
    ] = None,
    figures: Annotated[
        bool, typer.Option("--figures", help="Also write each diagram as PNG and SVG.")
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="A few cases and levels, and short runs.")
    ] = False,
) -> None:
    """Write all of the validation as one HTML page that needs nothing but itself.

    Exit status 1 if a part could not be measured or a case does not hold.
    """
    with _told():
        passed = _writer()(output, source, quick=quick, figures=figures)
    if not passed:
        raise typer.Exit(FAILED)


def _writer() -> Callable[..., bool]:
    """Return what writes reports, which needs libraries that nothing else does."""
    with needed_for("a report"):
        from validation.report.command import write
    return write


@app.command()
def stability(
    json_file: JsonFile = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Shorter runs; see only whether frontiers still hold.")
    ] = False,
    update: Annotated[
        bool, typer.Option("--update", help="Write down where the frontiers lie now.")
    ] = False,
) -> None:
    """Run the hard cases, and make them harder until they break, beside pymunk at the same cost.

    Exit status 1 if a case misses its bound, or a frontier has moved inward.
    """
    from validation.stability.command import measure  # what one command needs need not slow all

    with _told():
        failed = measure(json_file, quick=quick, update=update and not quick)
    if failed:
        raise typer.Exit(FAILED)


@app.command()
def fuzz(
    count: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="How many levels. [default: 1000]")
    ] = None,
    seed: Annotated[int, typer.Option(metavar="S", help="Which levels.")] = 0,
    minutes: Annotated[
        float | None,
        typer.Option(min=0, metavar="M", help="For how long; as many as that allows without N."),
    ] = None,
    json_file: JsonFile = None,
    samples: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Where what goes wrong is kept. [default: out/fuzz]"),
    ] = None,
) -> None:
    """Try levels that nobody would write: from the schema, and the project's own, changed.

    Each must be answered within two seconds of computing and 500 MB. What goes wrong is made as
    small as can be, and kept. Exit status 1 if anything did.
    """
    from validation.fuzz import command  # what one command needs need not slow all

    number = count or (None if minutes is not None else 1000)
    with _told():
        passed = command.fuzz(number, seed, minutes, json_file, samples or command.SAMPLES)
    if not passed:
        raise typer.Exit(FAILED)
