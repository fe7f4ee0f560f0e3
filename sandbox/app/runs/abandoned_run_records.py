"""Records of runs that were left, shown while the current run is computed again."""

from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.observing.earlier_runs import RunObservations
from sandbox.app.runs.user_interventions import Action

MOST = 3
"""The number of records that are kept. Moving a body by hand or branching starts a new one."""


class Record(NamedTuple):
    """A run that was left."""

    run: RunObservations
    """The observations of the run."""
    actions: Sequence[Action]
    """The user's actions on it."""

    def covers(self, step: int, actions: Sequence[Action]) -> bool:
        """Whether the record has the state after some step of a run with these actions."""
        names, done = (
            [action for action in each if action.step <= step] for each in (self.actions, actions)
        )
        begun = float(self.run.history.snapshots.t[0])
        return begun <= step * self.run.world.dt and step <= self.run.steps() and names == done


class Records(tuple[Record, ...]):
    """The last few records, the newest last."""

    __slots__ = ()

    def with_run(self, run: RunObservations, actions: Sequence[Action]) -> "Records":
        """Return the records with one more run, unless one of them covers its last step."""
        if any(each.covers(run.steps(), actions) for each in self):
            return self
        return Records((*self, Record(run, actions))[-MOST:])

    def show(self, step: int, actions: Sequence[Action]) -> RunObservations | None:
        """Set a recorded world to its state nearest to a step of a run with these actions.

        Returns the observations of that world; None if no record covers the step.
        """
        found = next((each.run for each in reversed(self) if each.covers(step, actions)), None)
        if found:
            found.world.recall(found.history.at(step * found.world.dt))
        return found
