"""The change of a quantity by each effect that a level neglects."""

from collections.abc import Iterator
from dataclasses import dataclass

from sandbox.app.pages.effects import switching_effects
from sandbox.app.runs.companion_runs import Changes
from sandbox.app.words import formatting
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Check, Level
from sandbox.model.levels_with_changed_effects import Variation
from sandbox.physics.measuring.grading import grade_check
from sandbox.physics.run import simulate


@dataclass(frozen=True, slots=True)
class TrialProgress:
    """The effect being tried, and the share of effects tried before."""

    effect: str
    share: float


@dataclass(frozen=True, slots=True)
class Trial:
    """A quantity without and with an effect; None if its instant never comes."""

    effects: tuple[Variation, ...]
    before: float | None
    after: float | None

    @property
    def label(self) -> str:
        """A description of the effects."""
        return formatting.variations(self.effects)


def trials(level: Level, values: Values, check: Check) -> Iterator[TrialProgress | Trial]:
    """Try each effect that a level does not declare, and yield the values of a check's quantity.

    Both runs have the same scheme, as on the page of the effects. Effects that are impossible here
    are left out.
    """
    alone = level.model_copy(update={"checks": (check,), "ghosts": {}, "challenge": None})
    names = switching_effects.addable(level)
    results: dict[str, float | None] = {}
    for i, name in enumerate(names):
        yield TrialProgress(name, i / len(names))
        try:
            plain, more, changes = switching_effects.changed(alone, Changes(on=(name,)))
            scheme = plain.stepping.scheme
            if scheme not in results:
                results[scheme] = _measured(plain, values, check)
            yield Trial(changes.effects, results[scheme], _measured(more, values, check))
        except SandboxError:
            continue


def _measured(level: Level, values: Values, check: Check) -> float | None:
    return grade_check(check, simulate(level, values)).measured
