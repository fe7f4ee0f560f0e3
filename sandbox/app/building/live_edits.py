"""Edits of a running level: bodies are added, removed or changed while it runs.

The present state is edited as a level, with which the run continues from this step on. The run
keeps the change among its actions, so that it can be repeated, shared and undone.
"""

from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import Part
from sandbox.app.runs.session import Session
from sandbox.app.words.language import later, say
from sandbox.editing.draft import Draft
from sandbox.editing.run_as_level import MOVES, as_it_stands
from sandbox.model.errors import SandboxError
from sandbox.model.shapes import XY
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.stepping.world import World

KEPT = later("The present state is a level of its own now; the original level is unchanged")


class EditableRun(EditedLevel):
    """The editable state of the run, on the stage while the run is shown.

    Attributes
    ----------
    session
        The session of the run.
    stands
        Whether time is stopped while something is being drawn into the run.
    """

    session: Session
    stands = False
    fixed = (*MOVES, "motion", "type")

    def __init__(self) -> None:
        super().__init__()
        self._seen: tuple[World, int] | None = None
        self._refused: Message = NOTHING

    @property
    def _now(self) -> tuple[World, int]:
        return self.session.world, self.session.world.steps

    @property
    def is_current(self) -> bool:
        """Whether it is the present state of the run."""
        return self._seen == self._now

    def read_state(self) -> None:
        """Read the present state of the run."""
        if self.is_current:
            return
        self._seen, chosen = self._now, self.selected
        try:
            self._refused, text = NOTHING, as_it_stands(self.session.world, anew=False)
        except SandboxError as error:
            self._refused = Message(
                "Nothing can be changed while it runs: {error}", error=error.message
            )
            return
        self.edit_draft(Draft.of(text))
        self.select(chosen)

    def stop_time(self) -> None:
        """Stop time while something is drawn into the run."""
        self.stands, self.session.playing = self.stands or self.session.playing, False

    def let_time_run(self) -> None:
        """Let time run again, if it was stopped."""
        if self.stands:
            self.stands, self.session.playing = False, self.session.failure is None

    def replace_text(self, text: str, caption: str, merge: str | None = None) -> None:
        """Let the run continue with a changed text.

        Raises `SandboxError` if it cannot; nothing is changed then.
        """
        if self._refused:
            raise SandboxError(self._refused)
        if text == self.text:
            return
        self.session.alter(text)
        super().replace_text(text, caption, merge)
        self._seen = self._now
        change = f"{caption[:1].upper()}{caption[1:]}"
        self.show_message(say("{change}, at {t:.2f} s", change=change, t=self.session.t))

    def part_at(self, pixel: XY) -> Part | None:
        """Return the body or joint at a pixel; None before the first frame."""
        return super().part_at(pixel) if self.is_current else None

    def as_level(self) -> Draft:
        """Return the present state as a level of its own.

        Raises `SandboxError` if no level can start from this state.
        """
        draft = Draft.of(self.session.original.text)
        draft.change(as_it_stands(self.session.world, anew=True), say("keep the run as a level"))
        return draft
