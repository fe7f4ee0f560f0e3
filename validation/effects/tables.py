"""What the measurements of `effects` found, as tables."""

from collections.abc import Sequence

from rich.table import Table

from validation.effects.costs import EffectCost, LevelCost


def level_table(costs: Sequence[LevelCost]) -> Table:
    """Return a row a level: what it declares, and what a step costs beside the bare engine."""
    table = Table(title="A step of each level", header_style="bold", row_styles=("", "dim"))
    table.add_column("level", no_wrap=True)
    table.add_column("effects and joints")
    for heading in ("hooks", "step", "bare", "ratio"):
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in costs:
        table.add_row(
            cost.level,
            ", ".join((*cost.effects, *cost.joints)),
            str(cost.hooks),
            _micro(cost.step_seconds),
            _micro(cost.bare_step_seconds),
            f"{cost.ratio:.2f}",
        )
    return table


def effect_table(costs: Sequence[EffectCost]) -> Table:
    """Return a row an effect: what it adds to a step, over numbers of bodies."""
    table = Table(title="What an effect adds to a step, over the number of bodies")
    table.add_column("effect", no_wrap=True)
    for count in costs[0].bodies:
        table.add_column(f"{count:,}", justify="right", no_wrap=True)
    table.add_column("step ~ n^p", justify="right", no_wrap=True)
    for cost in costs:
        exponent = "-" if cost.exponent is None else f"{cost.exponent:.2f}"
        table.add_row(cost.effect, *map(_micro, cost.seconds_per_step), exponent)
    return table


def _micro(seconds: float) -> str:
    return f"{seconds * 1e6:.1f} µs"
