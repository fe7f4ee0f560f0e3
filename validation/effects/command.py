"""`effects`: the measurements, printed and written."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from validation import output
from validation.effects import cost_growth, costs
from validation.effects.cost_growth import Growth
from validation.effects.costs import EffectCost, LevelCost
from validation.effects.tables import effect_table, growth_table, level_table
from validation.environment import environment


def measure(json_file: Path | None, *, quick: bool) -> None:
    """Measure levels, effects and crowds, print three tables, and write the figures if asked to.

    Raises `SandboxError` if a level cannot be measured, or the file cannot be written.
    """
    levels, effects, growths = measured(quick=quick)
    with output.written(content(levels, effects, growths), json_file):
        output.show(level_table(levels), effect_table(effects), growth_table(growths))


def measured(*, quick: bool) -> tuple[list[LevelCost], list[EffectCost], list[Growth]]:
    """Measure every level of the catalog, every effect, and the crowds."""
    levels = list(costs.level_costs(repeats=2 if quick else 5))
    effects = costs.effect_costs(costs.QUICK if quick else costs.COUNTS)
    return (
        levels,
        effects,
        list(cost_growth.growths(cost_growth.QUICK if quick else cost_growth.COUNTS)),
    )


def content(
    levels: Sequence[LevelCost], effects: Sequence[EffectCost], growths: Sequence[Growth]
) -> dict[str, object]:
    """Return the figures as the content of the JSON file."""
    return {
        "environment": environment(),
        "levels": [asdict(cost) for cost in levels],
        "costs": [asdict(cost) for cost in effects],
        "growth": [asdict(growth) for growth in growths],
    }
