"""`effects`: the measurements, shown and written."""

import json
from dataclasses import asdict
from pathlib import Path

import typer
from rich.console import Console

from sandbox.model.files import check_writable, write_atomically
from validation.effects import costs
from validation.effects.tables import effect_table, level_table
from validation.environment import environment


def measure(json_file: Path | None, *, quick: bool) -> None:
    """Measure levels and effects, show two tables, and write the figures if asked to.

    Raises
    ------
    SandboxError
        If a level cannot be measured, or the file not be written.
    """
    if json_file:
        check_writable(json_file)
    levels = list(costs.level_costs(repeats=2 if quick else 5))
    effects = costs.effect_costs(costs.QUICK if quick else costs.COUNTS)
    terminal = Console()
    for table in (level_table(levels), effect_table(effects)):
        Console(width=None if terminal.is_terminal else 160).print(table)
    if json_file:
        figures = {"levels": [asdict(o) for o in levels], "costs": [asdict(o) for o in effects]}
        content = {"environment": environment(), **figures}
        write_atomically(json_file, json.dumps(content, indent=2, ensure_ascii=False) + "\n")
        typer.echo(f"Written to {json_file}.")
