"""`effects`: what each effect of a level changes, and its cost."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import typer
from rich.console import Console

from sandbox.app.words import formatting
from sandbox.cli import argument_parsing, effect_options
from sandbox.cli.text_columns import aligned
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import without
from sandbox.model.loading import choose
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.run_comparison import Difference, compared_quantities, differences
from sandbox.physics.run import costs, simulate

_HEADER = ("effect", "changes most", "with it", "without it", "difference", "costs")


class Weight(NamedTuple):
    """The influence of an effect on a level."""

    effect: str
    gone: tuple[str, ...] = ()
    """the effects that depend on it"""
    worst: Difference | None = None
    """the largest change; None if the level cannot run without the effect"""
    cost: float = 0.0
    """s a step"""
    error: str = ""
    """why the level cannot run without the effect"""

    @property
    def share(self) -> float:
        """The size of the largest change."""
        return float("inf") if self.worst is None else self.worst.fraction


def weigh(argument: str, pairs: Sequence[str]) -> None:
    """Switch each effect off in turn, and print the changes, the largest first."""
    source, level = argument_parsing.open_level(argument)
    values = choose(level, argument_parsing.settings(pairs))
    declared = level.effects.declared
    if not declared:
        typer.echo(f"{source} declares no effect")
        return
    with Console(stderr=True).status(f"Weighing the effects of {source} ..."):
        trace = simulate(level, values, record=compared_quantities(level))
        found = [_weight(level, values, trace, effect) for effect in declared]
    ranked = sorted(found, key=lambda weight: -weight.share)
    for line in aligned([_HEADER, *map(_row, ranked)]):
        typer.echo(line)
    for line in _remarks(ranked):
        typer.echo(line)


def _weight(level: Level, values: Values, trace: Trace, effect: str) -> Weight:
    also_removed: tuple[str, ...] = ()
    try:
        less, also_removed = without(level, effect)
        other = simulate(less, values, record=trace.columns)
        full, bare = costs((level, less), values)
    except SandboxError as error:
        return Weight(effect, also_removed, error=str(error))
    worst = max(differences(trace, other, positions=True), key=lambda found: found.fraction)
    return Weight(effect, also_removed, worst, full - bare)


def _row(weight: Weight) -> tuple[str, ...]:
    worst = weight.worst
    if worst is None:
        return weight.effect, "the level cannot run without it", "", "", "", ""
    cost = formatting.step_cost(weight.cost)
    if not worst.fraction:
        return weight.effect, "nothing", "", "", formatting.NO_DIFFERENCE, cost
    return (weight.effect, *effect_options.row(worst), cost)


def _remarks(weights: Sequence[Weight]) -> Iterator[str]:
    """Yield the remarks that do not fit into the table."""
    for weight in weights:
        if weight.error:
            yield f"without {weight.effect}: {weight.error}"
        if weight.gone:
            yield f"without {weight.effect} there is no {', no '.join(weight.gone)} either"
        if weight.share == 0:
            yield f"'{weight.effect}' is declared but changes nothing here"
