"""What levels pay for Python in their steps."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from validation.effects.costs import LevelCost


@dataclass(frozen=True, slots=True)
class Hooks:
    """What levels pay for Python in their steps: the medians."""

    without: int
    ratio_without: float
    having: int
    added: float


def hooks(levels: Sequence[LevelCost]) -> Hooks:
    """Return what levels without hooks, and those that have one, pay beside the bare engine."""
    bare = [cost for cost in levels if not cost.hooks]
    having = [cost for cost in levels if cost.hooks]
    nothing = float("nan")
    return Hooks(
        len(bare),
        median([cost.ratio for cost in bare]) if bare else nothing,
        len(having),
        median([c.step_seconds - c.bare_step_seconds for c in having]) if having else nothing,
    )
