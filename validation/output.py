"""The output of measurements: progress, tables on the terminal, and JSON files.

A file names its environment: versions, machine, and cores.
"""

import json
import os
import platform
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, is_dataclass
from importlib.metadata import version
from math import isfinite
from pathlib import Path
from typing import Any, TypeVar

import typer
from rich.console import Console
from rich.table import Table

from sandbox import progress_bar
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.parallel_processes import spread
from sandbox.version import __version__

WIDE = 160
"""The width of a line without a terminal [characters]: enough for whole names."""

T = TypeVar("T")
Item = TypeVar("Item")


def spread_in_order(
    work: Callable[[Item], T], items: Sequence[Item], label: str, jobs: int | None = None
) -> list[T]:
    """Do work in several processes, with progress on a terminal, and return the results in order.

    For the processes see `sandbox.parallel_processes.spread`.
    """
    found = dict(progress_bar.consume(spread(work, items, jobs), label, len(items)))
    return [found[number] for number in range(len(items))]


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


def mark(*, passed: bool, beyond: bool = False) -> str:
    """Return the mark of what passed, or did not; a dash where that is out of reach."""
    return "[green]✓[/]" if passed else "[yellow]–[/]" if beyond else "[red]✗[/]"


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


def content(**parts: object) -> dict[str, Any]:
    """Return figures, also dataclasses, as the content of a JSON file that names the environment.

    Those that are infinite or NaN are null.
    """
    return {"environment": environment(), **{name: _finite(part) for name, part in parts.items()}}


def _finite(figures: object) -> object:
    if is_dataclass(figures) and not isinstance(figures, type):
        figures = asdict(figures)
    match figures:
        case float():
            return figures if isfinite(figures) else None
        case Mapping():
            return {name: _finite(value) for name, value in figures.items()}
        case list() | tuple():
            return [_finite(value) for value in figures]
    return figures


def environment() -> dict[str, str]:
    """Return the versions and the machine, by which a reader can judge the figures."""
    return {
        "sandbox": __version__,
        "python": platform.python_version(),
        **{package: version(package) for package in ("pymunk", "numpy", "pydantic")},
        "platform": platform.platform(),
        "processor": _processor(),
        "cores": str(os.cpu_count()),
    }


def _processor() -> str:
    """Return the processor's name; on systems other than Linux only its family."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
