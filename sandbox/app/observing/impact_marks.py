"""The impacts of a run that are marked on the bar of the time: the hardest of each step."""

from collections.abc import Sequence

from sandbox.app.observing.impacts import Blow

MOST = 60
"""How many impacts are marked; with more marks, nobody finds the right one."""
HARD = 0.1
"""The least strength of a marked impact, as `Blow.share`."""

ALIKE = 6
"""Decimals to which the strengths of impacts are compared, so that rounding does not order them."""


class ImpactMarks:
    """The hardest impact of each step at which there was a hard one."""

    def __init__(self) -> None:
        self._at: dict[int, Blow] = {}

    def note(self, blows: Sequence[Blow]) -> None:
        """Take in the impacts of a step; of equal ones it is the first that counts."""
        hardest = max(reversed(blows), key=lambda blow: round(blow.share, ALIKE), default=None)
        if hardest and hardest.share >= HARD and len(self._at) <= MOST:
            self._at[hardest.steps] = hardest

    def forget_after(self, steps: int) -> None:
        """Forget impacts after some step, since the run takes another course there."""
        self._at = {step: blow for step, blow in self._at.items() if step <= steps}

    @property
    def shown(self) -> Sequence[Blow]:
        """What is marked; nothing of a run with very many."""
        return list(self._at.values()) if len(self._at) <= MOST else ()
