"""The impacts of a run that are marked on the time bar: the hardest of each step."""

from collections.abc import Sequence

from sandbox.app.observing.impacts import Blow

MOST = 60
"""The largest number of marks; with more, the right one would be hard to find."""
HARD = 0.1
"""The least strength of a marked impact, as `Blow.share`."""

ALIKE = 6
"""Decimals in comparisons of strengths, so that rounding errors do not order impacts."""


class ImpactMarks:
    """The hardest impact of each step, if its strength is at least `HARD`."""

    def __init__(self) -> None:
        self._at: dict[int, Blow] = {}

    def note(self, blows: Sequence[Blow]) -> None:
        """Add the impacts of a step, the latest first; the earliest of the hardest is kept."""
        hardest = max(reversed(blows), key=lambda blow: round(blow.share, ALIKE), default=None)
        if hardest and hardest.share >= HARD and len(self._at) <= MOST:
            self._at[hardest.steps] = hardest

    def forget_after(self, steps: int) -> None:
        """Remove impacts after some step, from which the run takes another course."""
        self._at = {step: blow for step, blow in self._at.items() if step <= steps}

    @property
    def shown(self) -> Sequence[Blow]:
        """The impacts to mark; none if there are more than `MOST`."""
        return list(self._at.values()) if len(self._at) <= MOST else ()
