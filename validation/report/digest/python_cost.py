"""The cost of Python in the steps of levels."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from validation.effects.costs import LevelCost


@dataclass(frozen=True, slots=True)
class Hooks:
    """The median costs of Python in the steps of levels."""

    without: int
    ratio_without: float
    having: int
    added: float


def hooks(levels: Sequence[LevelCost]) -> Hooks:
    """Return the costs for levels without hooks, and with one, relative to the bare engine."""
    bare = [cost for cost in levels if not cost.hooks]
    having = [cost for cost in levels if cost.hooks]
    nothing = float("nan")
    return Hooks(
        len(bare),
        median([cost.ratio for cost in bare]) if bare else nothing,
        len(having),
        median([c.step_seconds - c.bare_step_seconds for c in having]) if having else nothing,
    )
