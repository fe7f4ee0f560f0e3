"""`python -m validation effects`: the measurements as tables and as JSON."""

from collections.abc import Sequence
from pathlib import Path

from rich.table import Table

from validation import output
from validation.effect_costs import comparison_with_bare_engine, cost_growth
from validation.effect_costs.comparison_with_bare_engine import EffectCost, LevelCost
from validation.effect_costs.cost_growth import Growth


def measure(json_file: Path | None, *, quick: bool) -> None:
    """Measure levels, effects and crowds, print three tables, and write the figures if asked to.

    Raises `SandboxError` if a level cannot be measured, or the file cannot be written.
    """
    levels, effects, growths = measured(quick=quick)
    with output.written(content(levels, effects, growths), json_file):
        output.show(level_table(levels), effect_table(effects), growth_table(growths))


def measured(*, quick: bool) -> tuple[list[LevelCost], list[EffectCost], list[Growth]]:
    """Measure every level of the catalog, every effect, and the crowds."""
    levels = list(comparison_with_bare_engine.level_costs(repeats=2 if quick else 5))
    effects = comparison_with_bare_engine.effect_costs(
        comparison_with_bare_engine.QUICK if quick else comparison_with_bare_engine.COUNTS
    )
    growths = cost_growth.growths(cost_growth.QUICK if quick else cost_growth.COUNTS)
    return levels, effects, list(growths)


def content(
    levels: Sequence[LevelCost], effects: Sequence[EffectCost], growths: Sequence[Growth]
) -> dict[str, object]:
    """Return the figures as the content of the JSON file."""
    return output.content(levels=levels, costs=effects, growth=growths)


def level_table(costs: Sequence[LevelCost]) -> Table:
    """Return a table with a row per level: what it declares, and the cost of a step."""
    table = Table(title="A step of each level", header_style="bold", row_styles=("", "dim"))
    table.add_column("level", no_wrap=True)
    table.add_column("effects and joints")
    for heading in ("hooks", "step", "bare", "ratio"):
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in costs:
        table.add_row(
            cost.level,
            ", ".join((*cost.effects, *cost.joints, *cost.ways)),
            str(cost.hooks),
            _micro(cost.step_seconds),
            _micro(cost.bare_step_seconds),
            f"{cost.ratio:.2f}",
        )
    return table


def effect_table(costs: Sequence[EffectCost]) -> Table:
    """Return a table with a row per effect: its cost for several numbers of bodies."""
    counts = sorted({count for cost in costs for count in cost.bodies})
    headings = (*(f"{count:,}" for count in counts), "step ~ n^p")
    title = "What an effect adds to a step, over the number of bodies"
    table = output.table(title, "effect", headings)
    for cost in costs:
        added = dict(zip(cost.bodies, cost.seconds_per_step, strict=True))
        cells = [_micro(added[count]) if count in added else "-" for count in counts]
        exponent = "-" if cost.exponent is None else f"{cost.exponent:.2f}"
        table.add_row(cost.effect, *cells, exponent)
    return table


def growth_table(growths: Sequence[Growth]) -> Table:
    """Return a table with a row per crowd and number of bodies: the costs here and in pymunk."""
    headings = ("bodies", "contacts", "a body", "growth", "bare: contacts", "a body", "growth")
    table = output.table("What a body costs a step, over the number of bodies", "scene", headings)
    for growth in growths:
        for row in rows(growth):
            table.add_row(growth.scene, *row)
    return table


def rows(growth: Growth) -> list[tuple[str, ...]]:
    """Return a row per number of bodies: the number; contacts, time and growth, ours and bare."""
    ours = _cells(growth.contacts_per_body, growth.seconds_per_body)
    bare = _cells(growth.bare_contacts_per_body, growth.bare_seconds_per_body)
    return [(f"{n:,}", *a, *b) for n, a, b in zip(growth.bodies, ours, bare, strict=True)]


def _cells(contacts: Sequence[float], seconds: Sequence[float]) -> list[tuple[str, str, str]]:
    pairs = zip(contacts, seconds, strict=True)
    return [(f"{c:.2f}", f"{s * 1e9:.0f} ns", f"{s / seconds[0]:.2f}") for c, s in pairs]


def _micro(seconds: float) -> str:
    return f"{seconds * 1e6:.1f} µs"
