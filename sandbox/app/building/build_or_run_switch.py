"""Switching between building the level and running it, with undo across both."""

from sandbox.app.building.current_tool import CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.rerun_after_edit import RerunAfterEdit
from sandbox.app.building.trial_run_history import TrialRuns
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError


class BuildOrRunSwitch:
    """Switches between building and the run; undo and redo work across both."""

    def __init__(
        self, work: EditedLevel, trial: TrialRuns, tools: CurrentTool, applying: RerunAfterEdit
    ) -> None:
        self._work, self._trial, self._tools, self._applying = work, trial, tools, applying

    @staticmethod
    def is_shown(session: Session) -> bool:
        """Return whether the run is shown rather than the level under edit."""
        return session.playing or session.world.steps > 0 or session.sought is not None

    def begin(self, session: Session) -> bool:
        """Prepare to let time run, and return whether it can; show the reason if not."""
        self._tools.cancel()
        if not self._applying.apply_pending(session):
            reason = self._applying.refusal
            self._work.show_message(say("It cannot run yet: {reason}", reason=reason))
            return False
        return True

    def toggle(self, session: Session) -> None:
        """Let time run; if the run is shown already, go back to the start."""
        if self.is_shown(session):
            self.back(session)
        elif self.begin(session):
            session.toggle()

    def back(self, session: Session) -> None:
        """Go back to the start, and to building; `return_to_run` returns to the run."""
        if self.is_shown(session):
            self._trial.store(session)
            session.restart()
            session.pause()
            session.forget_earlier()
        self.follow(session)

    def return_to_run(self, session: Session) -> None:
        """Continue the run of this level that was left."""
        self._applying.edit_shown_level(session)
        text = self._work.draft.text
        if self._applying.apply_pending(session) and self._trial.run_of(text):
            self._trial.return_to_run(session, text)
        self.follow(session)

    def follow(self, session: Session) -> None:
        """Let the tools act on the run or the level, whichever is shown."""
        live = self._trial.live
        live.session = session
        bench = live if self.is_shown(session) else self._work
        if bench is self._tools.bench:
            return
        selected = self._tools.bench.selected
        self._tools.turn_to(bench)
        live.stands = False
        if bench is live:
            live.read_state()
            live.select(selected)
        bench.show()

    def read_run_state(self, session: Session) -> None:
        """Read the state of the run before it is changed."""
        self.follow(session)
        if self._tools.bench is self._trial.live:
            self._trial.live.read_state()

    # undo and redo

    def undo(self, session: Session) -> None:
        """Undo the last change of the run; else the run itself, or a change of the level."""
        if not self.is_shown(session):
            self._work.undo()
        elif self._trial.has_changes(session):
            self._trial.undo_change(session)
            self._tools.bench.show_message(say("Undone: what was changed in the run"))
        else:
            self.back(session)
            self._work.show_message(say("Undone: the run; Ctrl Y comes back to it"))

    def redo(self, session: Session) -> None:
        """Redo the last undone change of the run, the run itself, or a change of the level.

        A change of the level is the next step of a run, too, which is left for it.
        """
        if self.is_shown(session) and self._level_is_next(session):
            self.back(session)
            self._work.redo()
        elif self.is_shown(session):
            self._change_again(session)
        elif self._trial.is_undone(self._work.draft.text):
            self.return_to_run(session)
        else:
            self._work.redo()

    def _level_is_next(self, session: Session) -> bool:
        """Return whether what was undone last before a run is a change of the level."""
        return (
            not self._trial.is_change_undone(session)
            and self._work.draft.redo_description is not None
        )

    def _change_again(self, session: Session) -> None:
        """Redo a change of the run that was undone."""
        bench = self._tools.bench
        try:
            done = self._trial.redo_change(session)
        except SandboxError as error:
            bench.show_message(say(error.message))
        else:
            bench.show_message(say("Done again") if done else say("Nothing to redo"))

    def undo_description(self, session: Session) -> str | None:
        """Return the description of what would be undone next; None if nothing."""
        if not self.is_shown(session):
            return self._work.draft.undo_description
        if self._trial.has_changes(session):
            return say("the last change of the run")
        return say("the run")

    def redo_description(self, session: Session) -> str | None:
        """Return the description of what would be redone next; None if nothing."""
        if self.is_shown(session):
            if self._trial.is_change_undone(session):
                return say("change the run")
        elif self._trial.is_undone(self._work.draft.text):
            return say("the run")
        return self._work.draft.redo_description
