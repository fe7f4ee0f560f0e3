"""`python -m validation report`."""

import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import typer
from rich.console import Console

from sandbox.model.atomic_file_writing import check_writable, folder_of_files, write_atomically
from sandbox.model.errors import MisuseError, SandboxError
from sandbox.reporting import plot_style
from validation.output import save
from validation.report import measurements, page

PAGE = "report.html"
FIGURES = "figures"

Contents = dict[str, measurements.Content | SandboxError]
"""What each part has measured so far, or why it could not."""


def write(output: Path, source: Path | None, *, quick: bool, figures: bool) -> bool:
    """Measure or read every part, write the page, and return whether everything passed.

    The folder of the page is made if missing; what each part has measured is stored there as JSON
    as soon as it is measured, and with `figures` the diagrams as separate files. A `source` has
    files of other commands, which are read instead of measuring again. If `quick`, only a few
    cases, levels and repetitions are measured. Raises `SandboxError` if the folder cannot be
    written, or there is nothing to read; what was measured is then stored elsewhere.
    """
    if source:
        _check_readable(source)
    contents: Contents = {}
    with folder_of_files(output), _rescued(contents):
        for name in (PAGE, *(f"{part.command}.json" for part in measurements.PARTS)):
            check_writable(output / name)  # not only after all has been measured
        for part in measurements.PARTS:
            contents[part.command] = content = _collected(part, source, quick=quick)
            _store(part.command, content, output)
        found = page.report(contents, quick=quick)
        if figures:
            _draw(found, output / FIGURES)
        write_atomically(output / PAGE, page.html(found))
    typer.echo(f"Written to {output / PAGE}.")
    for command, reason in found.failures.items():
        typer.echo(f"missing: {command}: {reason}", err=True)
    return found.passed


def _check_readable(folder: Path) -> None:
    """Refuse what is no folder, or a locked one: its files would be measured anew."""
    try:
        os.stat(os.path.join(folder, "."))
    except OSError as error:
        raise MisuseError(
            "cannot read {folder}: {reason}", folder=folder, reason=error.strerror
        ) from error


def _collected(
    part: measurements.Part, source: Path | None, *, quick: bool
) -> measurements.Content | SandboxError:
    """Return the measurements of a part, or the error; the other parts continue."""
    Console(stderr=True, highlight=False).print(f"validation {part.command} ...")
    try:
        return measurements.collect(part, source, quick=quick)
    except SandboxError as error:
        return error


def _store(command: str, content: measurements.Content | SandboxError, folder: Path) -> None:
    if isinstance(content, Mapping):
        save(content, folder / f"{command}.json")


@contextmanager
def _rescued(contents: Contents) -> Iterator[None]:
    """Store what was measured in a temporary folder if something cannot be written within this."""
    try:
        yield
    except SandboxError as error:
        if not contents:
            raise
        try:
            folder = Path(tempfile.mkdtemp(prefix="report-"))
            for command, content in contents.items():
                _store(command, content, folder)
        except (OSError, SandboxError):  # there is no room either
            raise error from None
        raise SandboxError(
            "{error}; what was measured is in {folder}, and `report --from {folder}` reads it",
            error=error.message,
            folder=folder,
        ) from error


def _draw(found: page.Report, folder: Path) -> None:
    with folder_of_files(folder):
        for name, figure in found.figures.items():
            for form in plot_style.FORMS:
                write_atomically(folder / f"{name}.{form}", plot_style.written(figure, form))
