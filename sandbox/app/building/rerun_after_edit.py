"""Applies the edited level to the session, after a short pause in the editing."""

import re
from time import perf_counter

from sandbox.app.building.current_tool import CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.kept_drafts import Drafts
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.state.simulation_errors import SimulationError

PATIENCE = 1.5
"""The pause before changes are applied, as a multiple of the time that applying them took."""


class RerunAfterEdit:
    """Applies the edited level to the session."""

    def __init__(self, work: EditedLevel, drafts: Drafts, tools: CurrentTool) -> None:
        self._work, self._drafts, self._tools = work, drafts, tools
        self.refusal: Message = NOTHING
        """The reason why the level cannot run as it is; empty if it can."""
        self.culprits: frozenset[str] = frozenset()
        """The bodies and joints that the reason names."""
        self._played: Level | None = None  # the version that the session has
        self._tried: object = self._state
        self._waits = 0.0  # s, until the changes are applied
        self._cost = 0.0  # s, the duration of the last application

    @property
    def _state(self) -> object:
        """The text and its file; changes of either are applied."""
        return self._work.version, self._work.draft.path

    @property
    def pending(self) -> bool:
        """Whether there are changes to be applied."""
        return self._tried != self._state

    def follow(self, session: Session, seconds: float, *, watched: bool) -> None:
        """Edit the level that is shown, and apply its changes after a pause."""
        if watched:
            self.edit_shown_level(session)
        if self.pending:
            self._waits -= seconds
            if not watched or (self._waits <= 0 and not self._tools.hand.busy):
                self.apply(session)

    def edit_shown_level(self, session: Session) -> None:
        """Edit the level that is shown, with its unsaved changes."""
        if session.original is self._played:
            return
        draft = self._drafts.of(session.original)
        self._work.edit_draft(draft)
        self._played, self._tried = session.original, self._state
        self.refusal, self.culprits = NOTHING, frozenset()
        if draft.text != session.original.text:
            self._work.show_message(say("Your changes are still here, but not saved"))
            self.apply(session)

    def apply_pending(self, session: Session) -> bool:
        """Apply any pending changes now, and return whether the level can run."""
        if self.pending:
            self.apply(session)
        return not self.refusal

    def apply(self, session: Session) -> None:
        """Apply the changes to the session; undo those that make the level invalid."""
        begun, work = perf_counter(), self._work
        level = self._last_level()
        self._tried = self._state
        self._tools.bench.show()
        self.refusal, self.culprits = NOTHING, frozenset()
        if level is None:
            self.refusal = work.mistake
            return
        try:
            session.edit(level)
            self._played = level
        except SandboxError as error:
            self._refuse(error)
        self._cost = perf_counter() - begun
        self._waits = PATIENCE * self._cost

    def _last_level(self) -> Level | None:
        """Return the level, after undoing the changes that made it invalid."""
        work = self._work
        level = work.draft.level
        if level is None:
            work.show_message(say("That cannot be: {mistake}", mistake=work.mistake))
            while level is None and work.draft.undo():
                level = work.draft.level
            work.refresh()
        return level

    def _refuse(self, error: SandboxError) -> None:
        """Set the reason why the level cannot run, and the parts that it names."""
        self.refusal = error.message
        if isinstance(error, SimulationError):
            self.refusal = error.reason
            if error.hint:
                self.refusal = Message("{told}; {advice}", told=error.reason, advice=error.hint)
            sketch = self._work.sketch
            named = {error.subject, *re.findall(r"'(\w+)'", error.reason)}
            self.culprits = frozenset(n for n in named if n in sketch.bodies or n in sketch.joints)
