"""The trial run of a level under edit: started, paused, altered on the way, and undone."""

import json
from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.building.live_edits import Live
from sandbox.app.runs.actions import Action
from sandbox.app.runs.session import Session
from sandbox.model.expressions import Values

MOST = 50
"""How many runs are kept, each of a different text."""


class Run(NamedTuple):
    """What makes a run the same again, and when it was left."""

    actions: Sequence[Action]
    steps: int
    values: Values
    t: float
    """s"""


class Trial:
    """What is known of the runs of a level under edit.

    Attributes
    ----------
    live
        The run that is shown, as tools see it.
    """

    def __init__(self) -> None:
        self.live = Live()
        self._left: dict[str, Run] = {}
        self._undone: list[Action] = []
        self._latest: str | None = None  # the text whose run was left last, and undone so

    def leave(self, session: Session) -> None:
        """Note a run before it is left for its start."""
        text = session.original.text
        steps = session.world.steps if session.sought is None else session.sought
        if steps:
            run = Run(tuple(session.all_actions), steps, session.begun_with, session.t)
            self._left.pop(text, None)
            self._left[text] = run
            self._latest = text
        while len(self._left) > MOST:
            del self._left[next(iter(self._left))]

    def left(self, text: str) -> Run | None:
        """Return the run that was left of a text, if one was."""
        return self._left.get(text)

    def come_back(self, session: Session, text: str) -> None:
        """Take the run of a text again that was left, to where it was left."""
        run = self._left[text]
        self._latest = None
        session.resume(run.actions, run.steps, run.values)

    def is_undone(self, text: str) -> bool:
        """Whether the next redo returns to the run."""
        return self._latest == text and text in self._left

    @staticmethod
    def changed(session: Session) -> bool:
        """Whether the run that is shown was changed on the way."""
        return any(action.kind == "alter" for action in session.all_actions)

    def take_back(self, session: Session) -> None:
        """Take back the last change of a run that was changed: it stands where that was done."""
        actions = session.all_actions
        *_, last = (i for i, action in enumerate(actions) if action.kind == "alter")
        self._undone.append(actions[last])
        session.resume(actions[:last], actions[last].step)

    def is_taken_back(self, session: Session) -> bool:
        """Whether the run stands where a change of it was taken back."""
        here = session.world.steps, session.sought
        return bool(self._undone) and here == (self._undone[-1].step, None)

    def do_again(self, session: Session) -> bool:
        """Change the run again where that was taken back; return whether that was so.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        if not self.is_taken_back(session):
            self._undone.clear()
            return False
        session.alter(json.dumps(self._undone.pop().level))
        return True
