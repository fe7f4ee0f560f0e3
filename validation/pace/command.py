"""`python -m validation pace`."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from rich.table import Table

from sandbox.model import level_catalog
from validation import output
from validation.environment import environment
from validation.pace.pace_measurement import Pace, pace


def measure(names: Sequence[str], json_file: Path | None) -> list[str]:
    """Measure levels, print the table, write it if asked to, and return the slow levels.

    Raises `SandboxError` if there is no such level, it does not run, or the file cannot be written.
    """
    names = list(names) or level_catalog.names()
    for name in names:
        level_catalog.find(name)
    found = output.progress(map(pace, names), "Measuring what levels need", len(names))
    with output.written(content(found), json_file):
        output.show(table(found))
    slow = [each.level for each in found if not each.in_time]
    output.complain(slow)
    return slow


def content(found: Sequence[Pace]) -> dict[str, object]:
    """Return the measurements of levels as the content of the JSON file."""
    return {"environment": environment(), "levels": [asdict(each) for each in found]}


def table(found: Sequence[Pace]) -> Table:
    """Return the load of each level, the highest first, as a table for the terminal."""
    headings = ("rate", "a step", "of this core", "of the reference", "")
    shown = output.table("What levels need", "level", headings)
    for each in sorted(found, key=lambda pace: -pace.reference_load):
        shown.add_row(
            each.level,
            f"{each.rate:g} Hz",
            f"{each.step_seconds * 1e6:.3g} µs",
            f"{100 * each.load:.2g} %",
            f"{100 * each.reference_load:.2g} %",
            "[green]✓[/]" if each.in_time else "[red]✗[/]",
        )
    return shown
