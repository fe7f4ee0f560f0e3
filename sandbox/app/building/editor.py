"""The editor: it takes the mouse while its page is open, and switches to the run and back.

What is built is drawn at its start, as its text says it. Once time runs the run is shown, the hand
is back, and tools throw things into the run; to go back to the start is to go back to building.
"""

from typing import TYPE_CHECKING

import pygame

from sandbox.app.building import keys
from sandbox.app.building.applying_changes import Applying
from sandbox.app.building.drafts import Drafts
from sandbox.app.building.edited_level import Work
from sandbox.app.building.editor_on_stage import EditorOnStage
from sandbox.app.building.live_edits import KEPT
from sandbox.app.building.mode_switch import ModeSwitch
from sandbox.app.building.saving import Saving
from sandbox.app.building.toolbox import FIRST, Toolbox
from sandbox.app.building.trial_run import Trial
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.words.language import say
from sandbox.editing.draft import Draft
from sandbox.model.errors import SandboxError

if TYPE_CHECKING:
    from collections.abc import Callable


class Editor:
    """What the Build page finds out, does and shows; there is one a window.

    Attributes
    ----------
    work
        The level under edit.
    trial
        The runs of the level.
    drafts
        The other levels that were edited.
    tools
        What changes the level, or its run.
    applying
        Plays what was changed, or says why it cannot run.
    trying
        Goes from building to the run and back.
    saving
        The level's file.
    complete
        Takes the first name that the page offers, and tells whether one is.
    """

    def __init__(self) -> None:
        self.work, self.drafts, self.trial = Work(), Drafts(), Trial()
        self.tools = Toolbox(self.work, self.trial.live)
        self.applying = Applying(self.work, self.drafts, self.tools)
        self.trying = ModeSwitch(self.work, self.trial, self.tools, self.applying)
        self.saving = Saving(self.work, self.drafts, self.tools)
        self.complete: Callable[[], bool] = bool
        self._on_stage = EditorOnStage(self.work, self.trial.live, self.tools, self.applying)

    @property
    def bench(self) -> Work:
        """What is on the stage, and tools change: the level, or its run."""
        return self.tools.bench

    @property
    def news(self) -> object:
        """Another object whenever something else is to be shown."""
        return self.bench.news

    @property
    def running(self) -> bool:
        """Whether something is still to be tried."""
        return self.applying.pending

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Take up the level that is shown, and let the session play its changes."""
        if not watched:
            self.complete = bool  # or a page that is gone would stay, with its session
        self.applying.follow(session, seconds, watched=watched)
        if self.drafts.follow(self.work.draft, seconds):
            self.bench.show()
        if watched:
            self.trying.follow(session)
        return self.bench.take_message() or self.work.take_message()

    def cancel(self) -> None:
        """Keep what is not saved for the next time."""
        self.drafts.keep()

    # which level

    def begin(self, session: Session, draft: Draft) -> None:
        """Edit another draft, and let the session play it."""
        self.drafts.add(draft)
        self.work.take(draft)
        self.tools.choose(FIRST)
        self.applying.apply(session)

    def new(self, session: Session) -> None:
        """Begin an empty scene; the level edited before keeps its changes."""
        self.begin(session, Draft.empty())

    def save(self, session: Session) -> None:
        """Save the level that is shown, whichever page is open, or ask for its name."""
        self.applying.take_up(session)
        self.saving.save()

    def keep_run(self, session: Session) -> None:
        """Go on building with the present state of the run as a level of its own."""
        try:
            draft = self.trial.live.kept()
        except SandboxError as error:
            self.bench.tell(say(error.message))
            return
        self.begin(session, draft)
        self.trying.follow(session)
        self.work.tell(say(KEPT))

    # keys, mouse and stage

    def command(self, command: str, session: Session) -> bool:
        """Refuse to run a level with mistakes; reload a file without losing the changes."""
        if command in ("play", "step") and not self.trying.is_shown(session):
            return not self.trying.begin(session)
        if command == "next field":
            return self.complete()
        if command == "reload":
            self.saving.reload()
        return command == "reload"

    def key(self, event: pygame.event.Event, session: Session) -> bool:
        """Do what a key means while something is built, and return whether it means anything."""
        return keys.press(self, event, session)

    def process(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Let the tool in hand do what the mouse asks for."""
        self.trying.follow(session)
        return self._on_stage.process(event, area, stage)

    def go_on(self) -> None:
        """Let time run again, once nothing is being drawn into the run."""
        self._on_stage.go_on()

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw what is built, unless time runs."""
        self.work.camera = stage.camera
        if self.trying.is_shown(session):
            return False
        self._on_stage.draw(surface, stage, pen)
        return True

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw over the run what is selected in it, and what is being drawn into it."""
        self._on_stage.draw_over(surface, stage, pen)
