"""Recorded runs that were left; they are shown while the present run is computed again."""

from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.observing.earlier_runs import Observed
from sandbox.app.runs.actions import Action

MOST = 3
"""How many runs are kept. A new one begins where a hand moves a body, or the run branches."""


class Record(NamedTuple):
    """A run that was left.

    Attributes
    ----------
    run
        The observations of the run.
    actions
        What a person did to it.
    """

    run: Observed
    actions: Sequence[Action]

    def covers(self, step: int, actions: Sequence[Action]) -> bool:
        """Whether a run with these actions comes to the same state after some step."""
        known, done = (
            [action for action in each if action.step <= step] for each in (self.actions, actions)
        )
        begun = float(self.run.history.snapshots.t[0])
        return begun <= step * self.run.world.dt and step <= self.run.steps() and known == done


class Records(tuple[Record, ...]):
    """The last runs that were left, the newest last."""

    __slots__ = ()

    def having(self, run: Observed, actions: Sequence[Action]) -> "Records":
        """Return them with a run to which this was done, unless one of them has come as far."""
        if any(each.covers(run.steps(), actions) for each in self):
            return self
        return Records((*self, Record(run, actions))[-MOST:])

    def show(self, step: int, actions: Sequence[Action]) -> Observed | None:
        """Let a world show what is kept nearest to a step of a run; None if it is in no record."""
        found = next((each.run for each in reversed(self) if each.covers(step, actions)), None)
        if found:
            found.world.recall(found.history.at(step * found.world.dt))
        return found
