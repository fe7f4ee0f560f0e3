"""The output of measurements: progress, tables on the terminal, JSON files."""

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from typing import TypeVar

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from sandbox.model.file_writing import write_atomically

WIDE = 160
"""The width of a line without a terminal [characters]: enough for whole names."""

T = TypeVar("T")


def progress(things: Iterable[T], label: str, total: int) -> list[T]:
    """Consume an iterable, with progress on a terminal, and return its items."""
    console = Console(stderr=True)
    hidden = not console.is_terminal
    return list(track(things, label, total, console=console, transient=True, disable=hidden))


def show(*tables: Table) -> None:
    """Print tables."""
    console = Console(width=None if Console().is_terminal else WIDE)
    for table in tables:
        console.print(table)


def table(title: str, first: str, headings: Iterable[str]) -> Table:
    """Return an empty table with a column of words, and columns of figures."""
    made = Table(title=title, header_style="bold", row_styles=("", "dim"))
    made.add_column(first)
    for heading in headings:
        made.add_column(heading, justify="right", no_wrap=True)
    return made


def complain(failed: Iterable[str]) -> None:
    """Print the names of what failed."""
    for name in failed:
        typer.echo(f"failed: {name}", err=True)


@contextmanager
def written(content: object, file: Path | None) -> Iterator[None]:
    """Show figures within this; they are written to a file, if one is given, however that ends.

    The reader of the output may have gone, or its disk may be full. Raises `SandboxError` if the
    file cannot be written.
    """
    try:
        yield
    finally:
        if file:
            save(content, file)
            typer.echo(f"Written to {file}.")


def save(content: object, file: Path) -> None:
    """Write figures to a file as JSON; raise `SandboxError` if it cannot be written."""
    write_atomically(file, json.dumps(content, indent=2, ensure_ascii=False) + "\n")


def finite(figures: Mapping[str, object]) -> dict[str, object]:
    """Return figures as JSON content: those that are infinite or NaN are null."""
    return {
        name: None if isinstance(value, float) and not isfinite(value) else value
        for name, value in figures.items()
    }
