"""The editor, which handles the mouse while its page is open, and switches to the run and back.

The level under edit is drawn at its start, from its text. Once time runs, the run is shown, the
mouse grabs bodies again, and tools add things to the run; going back to the start is going back to
building.
"""

from typing import TYPE_CHECKING

import pygame

from sandbox.app.building import editor_keys
from sandbox.app.building.build_or_run_switch import BuildOrRunSwitch
from sandbox.app.building.current_tool import FIRST, CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.editor_on_stage import EditorOnStage
from sandbox.app.building.effect_costs import EffectCosts
from sandbox.app.building.kept_drafts import Drafts
from sandbox.app.building.live_edits import KEPT
from sandbox.app.building.rerun_after_edit import RerunAfterEdit
from sandbox.app.building.saving_and_reloading import Saving
from sandbox.app.building.trial_run_history import TrialRuns
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.words.language import say
from sandbox.editing.draft import Draft
from sandbox.model.errors import SandboxError

if TYPE_CHECKING:
    from collections.abc import Callable


class Editor:
    """The worker of the Build page, one for each window."""

    def __init__(self) -> None:
        self.work = EditedLevel()
        """The level under edit."""
        self.drafts = Drafts()
        """The drafts of all edited levels."""
        self.trial = TrialRuns()
        """The runs of the level."""
        self.tools = CurrentTool(self.work, self.trial.live)
        """The tools that change the level, or its run."""
        self.applying = RerunAfterEdit(self.work, self.drafts, self.tools)
        """Applies changes to the session, or gives the reason why the level cannot run."""
        self.trying = BuildOrRunSwitch(self.work, self.trial, self.tools, self.applying)
        """Switches between building and the run."""
        self.saving = Saving(self.work, self.drafts, self.tools)
        """Saves and reads the level's file."""
        self.costs = EffectCosts()
        """Measures what each effect costs."""
        self.complete: Callable[[], bool] = bool
        """Accepts the first name that the page offers, and returns whether there is one."""
        self._news: tuple[object, object] | None = None
        self._on_stage = EditorOnStage(self.work, self.trial.live, self.tools, self.applying)

    @property
    def bench(self) -> EditedLevel:
        """The level or its run, whichever is on the stage, and changed by the tools."""
        return self.tools.bench

    @property
    def news(self) -> object:
        """An object that differs whenever the display must change."""
        now = self.bench.news, self.costs.news
        if now != self._news:  # else the same tuple: a new one would redraw every page, each frame
            self._news = now
        return self._news

    @property
    def running(self) -> bool:
        """Whether there are changes to be applied."""
        return self.applying.pending

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Edit the level that is shown, and apply its changes to the session."""
        if not watched:
            self.complete = bool  # else a closed page would stay in memory, with its session
        self.costs.follow()
        self.applying.follow(session, seconds, watched=watched)
        if self.drafts.follow(self.work.draft, seconds):
            self.bench.show()
        if watched:
            self.trying.follow(session)
        return self.bench.take_message() or self.work.take_message()

    def cancel(self) -> None:
        """Write recovery files for unsaved changes, and stop timing effects."""
        self.drafts.keep()
        self.costs.cancel()

    # levels

    def begin(self, session: Session, draft: Draft) -> None:
        """Edit another draft, and let the session run it."""
        self.drafts.add(draft)
        self.work.edit_draft(draft)
        self.tools.choose(FIRST)
        self.applying.apply(session)

    def new(self, session: Session) -> None:
        """Start an empty scene; the previous level keeps its changes."""
        self.begin(session, Draft.empty())

    def save(self, session: Session) -> None:
        """Save the level that is shown, whichever page is open, or ask for a name."""
        self.applying.edit_shown_level(session)
        self.saving.save()

    def time_effects(self) -> None:
        """Begin to measure what each effect costs, if the level is valid."""
        if (level := self.work.draft.level) is not None:
            self.costs.measure(level, self.work.version)

    def keep_run(self, session: Session) -> None:
        """Edit the present state of the run as a new level."""
        try:
            draft = self.trial.live.as_level()
        except SandboxError as error:
            self.bench.show_message(say(error.message))
            return
        self.begin(session, draft)
        self.trying.follow(session)
        self.work.show_message(say(KEPT))

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
        """Handle a key, and return whether it has a meaning here."""
        return editor_keys.press(self, event, session)

    def process(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Pass a mouse event to the current tool, and return whether it was for it."""
        self.trying.follow(session)
        return self._on_stage.process(event, area, stage)

    def resume_time(self) -> None:
        """Let time run again unless something is being drawn into the run."""
        self._on_stage.resume_time()

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw the level under edit, and return whether it is shown rather than the run."""
        self.work.camera = stage.camera
        if self.trying.is_shown(session):
            return False
        self._on_stage.draw(surface, stage, pen)
        return True

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw the selection over the run, and the preview of what is added to it."""
        self._on_stage.draw_over(surface, stage, pen)
