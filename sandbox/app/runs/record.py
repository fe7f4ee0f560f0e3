"""What was recorded of a run, which is shown while the run is taken again."""

from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.observing.earlier_runs import Observed
from sandbox.app.runs.actions import Action


class Record(NamedTuple):
    """A run that was left.

    Attributes
    ----------
    run
        What was seen of it.
    actions
        What a person did to it.
    """

    run: Observed
    actions: Sequence[Action]

    def covers(self, step: int, actions: Sequence[Action]) -> bool:
        """Whether a run to which this was done comes to the same state after so many steps."""
        known, done = (
            [action for action in each if action.step <= step] for each in (self.actions, actions)
        )
        begun = float(self.run.history.snapshots.t[0])
        return begun <= step * self.run.world.dt and step <= self.run.steps() and known == done

    def show(self, step: int, actions: Sequence[Action]) -> bool:
        """Let its world show what is kept nearest to a step; return whether it is known at all."""
        covered = self.covers(step, actions)
        if covered:
            self.run.world.recall(self.run.history.at(step * self.run.world.dt))
        return covered
