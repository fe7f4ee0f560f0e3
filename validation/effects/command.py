"""`effects`: the measurements, shown and written."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import typer
from rich.console import Console

from sandbox.model.files import check_writable, write_atomically
from validation.effects import costs
from validation.effects.costs import EffectCost, LevelCost
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
    levels, effects = measured(quick=quick)
    terminal = Console()
    for table in (level_table(levels), effect_table(effects)):
        Console(width=None if terminal.is_terminal else 160).print(table)
    if json_file:
        figures = content(levels, effects)
        write_atomically(json_file, json.dumps(figures, indent=2, ensure_ascii=False) + "\n")
        typer.echo(f"Written to {json_file}.")


def measured(*, quick: bool) -> tuple[list[LevelCost], list[EffectCost]]:
    """Measure every level of the catalog, and every effect."""
    levels = list(costs.level_costs(repeats=2 if quick else 5))
    return levels, costs.effect_costs(costs.QUICK if quick else costs.COUNTS)


def content(levels: Sequence[LevelCost], effects: Sequence[EffectCost]) -> dict[str, object]:
    """Return the figures as the JSON file holds them."""
    return {
        "environment": environment(),
        "levels": [asdict(cost) for cost in levels],
        "costs": [asdict(cost) for cost in effects],
    }
