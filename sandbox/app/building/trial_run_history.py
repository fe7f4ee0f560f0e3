"""The trial runs of a level under edit: they can be left, resumed, changed and undone."""

import json
from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.building.live_edits import EditableRun
from sandbox.app.runs.session import Session
from sandbox.app.runs.user_interventions import Action
from sandbox.model.expressions import Values

MOST = 50
"""The largest number of runs that are kept, each of a different text."""


class Run(NamedTuple):
    """What is needed to repeat a run, and the time at which it was left."""

    actions: Sequence[Action]
    steps: int
    values: Values
    t: float
    """s, the time at which it was left"""


class TrialRuns:
    """The runs of a level under edit."""

    def __init__(self) -> None:
        self.live = EditableRun()
        """The run on the stage, as the tools see it."""
        self._left: dict[str, Run] = {}
        self._undone: list[Action] = []
        self._latest: str | None = None  # the text whose run was left last, and can be redone

    def store(self, session: Session) -> None:
        """Store a run before going back to its start."""
        text = session.original.text
        steps = session.world.steps if session.sought is None else session.sought
        if steps:
            run = Run(tuple(session.all_actions), steps, session.begun_with, session.t)
            self._left.pop(text, None)
            self._left[text] = run
            self._latest = text
        while len(self._left) > MOST:
            del self._left[next(iter(self._left))]

    def run_of(self, text: str) -> Run | None:
        """Return the run that was left of a text; None if there is none."""
        return self._left.get(text)

    def return_to_run(self, session: Session, text: str) -> None:
        """Repeat the run of a text up to where it was left."""
        run = self._left[text]
        self._latest = None
        session.resume(run.actions, run.steps, run.values)

    def is_undone(self, text: str) -> bool:
        """Return whether the next redo returns to the run."""
        return self._latest == text and text in self._left

    @staticmethod
    def has_changes(session: Session) -> bool:
        """Return whether the run was changed on the way."""
        return any(action.kind == "alter" for action in session.all_actions)

    def undo_change(self, session: Session) -> None:
        """Undo the last change of a run, and return to the step at which it was made."""
        actions = session.all_actions
        *_, last = (i for i, action in enumerate(actions) if action.kind == "alter")
        self._undone.append(actions[last])
        session.resume(actions[:last], actions[last].step)

    def is_change_undone(self, session: Session) -> bool:
        """Return whether the run is at the step at which a change was undone."""
        position = session.world.steps, session.sought
        return bool(self._undone) and position == (self._undone[-1].step, None)

    def redo_change(self, session: Session) -> bool:
        """Redo a change that was undone at this step, and return whether there was one.

        Raises `SandboxError` if it is impossible; nothing is changed then.
        """
        if not self.is_change_undone(session):
            self._undone.clear()
            return False
        session.alter(json.dumps(self._undone.pop().level))
        return True
