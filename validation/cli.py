"""The commands of `python -m validation`."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from sandbox.model.errors import SandboxError
from sandbox.model.files import check_writable, write_atomically
from validation import suite
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


@app.callback()
def validation() -> None:
    """Hold the sandbox against the textbook: every case beside pymunk used as it comes."""


@app.command(name="run")
def run_cases(json_file: JsonFile = None) -> None:
    """Run every case against its closed form, beside pymunk used naively.

    Exit status 1 if a case misses its bound, or if naive pymunk meets one that it should miss.
    """
    try:
        if json_file:
            check_writable(json_file)
        cases = list(all_cases())
        outcomes = suite.outcomes(cases)
        Console(width=_width()).print(suite.table(cases, outcomes))
        if json_file:
            text = json.dumps(suite.content(outcomes), indent=2, ensure_ascii=False)
            write_atomically(json_file, text + "\n")
            typer.echo(f"Written to {json_file}.")
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(2) from None
    failed = [suite.named(case) for case, o in zip(cases, outcomes, strict=True) if not o.passed]
    for name in failed:
        typer.echo(f"failed: {name}", err=True)
    typer.echo(f"{len(cases) - len(failed)} of {len(cases)} cases hold.")
    if failed:
        raise typer.Exit(1)


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

    try:
        failed = measure(levels or [], json_file, output, quick=quick)
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(2) from None
    if failed:
        raise typer.Exit(1)


@app.command()
def effects(
    json_file: JsonFile = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Fewer repetitions, and no more than 100 bodies.")
    ] = False,
) -> None:
    """Measure what each level pays beside the bare engine, and each effect over many bodies."""
    from validation.effects.command import measure  # what one command needs need not slow all

    try:
        measure(json_file, quick=quick)
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(2) from None


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
    try:
        passed = _writer()(output, source, quick=quick, figures=figures)
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(2) from None
    if not passed:
        raise typer.Exit(1)


def _writer() -> Callable[..., bool]:
    """Return what writes reports, which needs libraries that nothing else does."""
    try:
        from validation.report.command import write
    except ModuleNotFoundError as error:
        raise SandboxError(
            f"a report needs the library {error.name!r}, which is not installed:"
            " python -m pip install 'mechanics-sandbox[report]' (in a checkout: -e '.[report]')"
        ) from error
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

    try:
        failed = measure(json_file, quick=quick, update=update and not quick)
    except SandboxError as error:
        typer.echo(error, err=True)
        raise typer.Exit(2) from None
    if failed:
        raise typer.Exit(1)


def _width() -> int | None:
    """Return the width of a terminal; a pipe or a log has room for whole names."""
    return None if Console().is_terminal else 160
