"""`python -m validation report`."""

from collections.abc import Mapping
from pathlib import Path

import typer
from rich.console import Console

from sandbox.model.errors import MisuseError, SandboxError
from sandbox.model.files import folder_of_files, write_atomically
from sandbox.model.message import Message
from sandbox.reporting import plots
from validation.output import save
from validation.report import page, parts

PAGE = "report.html"
FIGURES = "figures"


def write(output: Path, source: Path | None, *, quick: bool, figures: bool) -> bool:
    """Measure or read every part, write the page, and return whether everything passed.

    The folder of the page is made if missing; the figures of the page are stored there as JSON, and
    with `figures` the diagrams as separate files. A `source` has files of other commands, which are
    read instead of measuring again. If `quick`, only a few cases, levels and repetitions are
    measured. Raises `SandboxError` if the folder cannot be written, or there is nothing to read.
    """
    if source and not source.is_dir():
        raise MisuseError(Message("cannot read {source}: there is no such folder", source=source))
    with folder_of_files(output):
        contents = {part.command: _collected(part, source, quick=quick) for part in parts.PARTS}
        found = page.report(contents, quick=quick)
        for command, content in contents.items():
            if isinstance(content, Mapping):
                save(content, output / f"{command}.json")
        if figures:
            _draw(found, output / FIGURES)
        write_atomically(output / PAGE, page.html(found))
    typer.echo(f"Written to {output / PAGE}.")
    for command, reason in found.failures.items():
        typer.echo(f"missing: {command}: {reason}", err=True)
    return found.passed


def _collected(
    part: parts.Part, source: Path | None, *, quick: bool
) -> parts.Content | SandboxError:
    """Return the measurements of a part, or the error; the other parts continue."""
    Console(stderr=True, highlight=False).print(f"validation {part.command} ...")
    try:
        return parts.collect(part, source, quick=quick)
    except SandboxError as error:
        return error


def _draw(found: page.Report, folder: Path) -> None:
    with folder_of_files(folder):
        for name, figure in found.figures.items():
            for form in plots.FORMS:
                write_atomically(folder / f"{name}.{form}", plots.written(figure, form))
