"""The editor: it takes the mouse while its page is open, and switches to the run and back.

What is built is drawn at its start, as its text says it. Once time runs the run is shown, the hand
is back, and tools throw things into the run; to go back to the start is to go back to building.
"""

import re
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import pygame

from sandbox.app.building import keys, painting
from sandbox.app.building.drafts import Drafts
from sandbox.app.building.edited_level import Work
from sandbox.app.building.live_edits import KEPT
from sandbox.app.building.pointer import Spot
from sandbox.app.building.tools.joining import JoinTool
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.building.tools.tool import Tool
from sandbox.app.building.trial_run import Trial
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.words.language import say
from sandbox.editing.draft import Draft
from sandbox.model.errors import SandboxError
from sandbox.model.message import NOTHING, Message
from sandbox.model.shapes import XY
from sandbox.physics.state.errors import SimulationError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from sandbox.model.level import Level

PATIENCE = 1.5
"""How long nothing is changed before the level is tried, as a multiple of what that takes."""


class Editor:
    """What the Build page finds out, does and shows; there is one a window.

    Attributes
    ----------
    work
        The level under edit.
    trial
        Its runs.
    bench
        What is on the stage, and tools change: the level, or its run.
    drafts
        The other levels that were edited.
    tool
        The name of the tool in hand.
    refusal
        Why the level cannot run as it is; empty if it can.
    culprits
        The bodies and joints that are to blame for that.
    naming
        Whether a person is asked under which name to save.
    complete
        Takes the first name that the page offers, and tells whether one is.
    """

    def __init__(self) -> None:
        self.work, self.drafts, self.trial = Work(), Drafts(), Trial()
        self.bench: Work = self.work
        self.tool = TOOLS[0].name
        self.refusal: Message = NOTHING
        self.naming = False
        self.culprits: frozenset[str] = frozenset()
        self.complete: Callable[[], bool] = bool
        self._tools: Mapping[Work, Mapping[str, Tool]] = {
            bench: {kind.name: kind.make(bench) for kind in TOOLS}
            for bench in (self.work, self.trial.live)
        }
        self._laid_down = self.tool  # while the run is shown
        self._stands = False  # whether time stands until what is drawn into the run is done
        self._played: Level | None = None  # what the session has of it
        self._tried: object = self.work.version
        self._waits = 0.0  # s, until what was changed is tried
        self._cost = 0.0  # s, what that took last
        self._spot: Spot | None = None
        self._picture = painting.Picture()

    @property
    def news(self) -> object:
        """Another object whenever something else is to be shown."""
        return self.bench.news

    def show(self) -> None:
        """Let the page be drawn anew."""
        self.bench.news = object()

    @property
    def running(self) -> bool:
        """Whether something is still to be tried."""
        return self._tried is not self.work.version

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Keep to the level that is shown, and let the session play what was changed."""
        if not watched:
            self.complete = bool  # or a page that is gone would stay, with its session
        if watched and session.original is not self._played:
            self._take_up(session)
        if self.running:
            self._waits -= seconds
            if not watched or (self._waits <= 0 and not self.hand.busy):
                self.settle(session)
        if self.drafts.follow(self.work.draft, seconds):
            self.show()
        if watched:
            self._look_at(session)
        return self.bench.take_message() or self.work.take_message()

    def cancel(self) -> None:
        """Keep what is not saved for the next time."""
        self.drafts.keep()

    def _take_up(self, session: Session) -> None:
        """Edit the level that is shown; what was not saved of it is still there."""
        draft = self.drafts.of(session.original)
        self.work.take(draft)
        self._played, self._tried = session.original, self.work.version
        self.refusal, self.culprits = NOTHING, frozenset()
        if draft.text != session.original.text:
            self.work.tell(say("What you have changed is still here, and not saved"))
            self.settle(session)

    def begin(self, session: Session, draft: Draft) -> None:
        """Edit another draft, and let the session play it."""
        self.drafts.add(draft)
        self.work.take(draft)
        self.choose(TOOLS[0].name)
        self.settle(session)

    def new(self, session: Session) -> None:
        """Begin an empty scene; what was built before is kept as it is."""
        self.begin(session, Draft.empty())

    def settle(self, session: Session) -> bool:
        """Let the session play what was changed, and return whether it can be run."""
        begun, work = perf_counter(), self.work
        level = work.draft.level
        if level is None:
            work.tell(say("That cannot be: {mistake}", mistake=work.mistake))
            while level is None and work.draft.undo():
                level = work.draft.level
            work.refresh()
        self._tried = work.version
        self.show()
        self.refusal, self.culprits = NOTHING, frozenset()
        if level is None:
            self.refusal = work.mistake
            return False
        try:
            session.edit(level)
            self._played = level
        except SandboxError as error:
            self._refuse(error)
        self._cost = perf_counter() - begun
        self._waits = PATIENCE * self._cost
        return not self.refusal

    def _refuse(self, error: SandboxError) -> None:
        """Say why the level cannot run, and where."""
        self.refusal = error.message
        if isinstance(error, SimulationError):
            self.refusal = error.reason
            if error.hint:
                self.refusal = Message("{told}; {advice}", told=error.reason, advice=error.hint)
            sketch = self.work.sketch
            named = {error.subject, *re.findall(r"'(\w+)'", error.reason)}
            self.culprits = frozenset(n for n in named if n in sketch.bodies or n in sketch.joints)

    # the tool in hand

    @property
    def hand(self) -> Tool:
        """The tool in hand."""
        return self._tools[self.bench][self.tool]

    @property
    def joining(self) -> JoinTool:
        """The tool that makes joints."""
        tool = self._tools[self.bench]["join"]
        assert isinstance(tool, JoinTool)
        return tool

    def choose(self, tool: str) -> None:
        """Take a tool in hand."""
        while self.hand.busy:
            self.hand.cancel()
        self.tool = tool
        self.show()

    def give_up(self) -> None:
        """Give up what was begun; if nothing is, select nothing; then take up the first tool."""
        if self.hand.busy:
            self.hand.cancel()
        elif self.bench.selected:
            self.bench.select(())
        else:
            self.choose(TOOLS[0].name)

    # its file

    def save(self, path: Path | None = None, *, overwrite: bool = False) -> None:
        """Save the level to its file, or to another.

        Without a file of its own it asks for a name; a level of the project has none.
        """
        draft = self.work.draft
        if path is None and not self.drafts.is_own(draft):
            self.save_as()
            return
        try:
            self.drafts.save(draft, path, overwrite=overwrite)
        except SandboxError as error:
            self.work.tell(say(error.message))
            return
        self.naming, self._tried = False, None  # its level has another place now
        self.work.tell(say("Saved {path}", path=draft.path))

    def save_as(self) -> None:
        """Ask for the name under which to save."""
        self.naming = True
        self.show()

    def stop_naming(self) -> None:
        """Go on without saving."""
        self.naming = False
        self.show()

    def reload(self) -> None:
        """Read the file again, as a step that can be undone."""
        try:
            self.work.draft.reload()
        except SandboxError as error:
            self.work.tell(say(error.message))
            return
        self.drafts.outside = False
        self.work.refresh()
        self.work.tell(say("Read again; Ctrl+Z brings your version back"))

    @property
    def proposed(self) -> Path:
        """The name that is proposed for the file."""
        return self.drafts.proposed(self.work.draft, str(self.work.document.get("title", "")))

    # the run

    @staticmethod
    def trying(session: Session) -> bool:
        """Whether the run is shown, and not the level as it is built."""
        return session.playing or session.world.steps > 0 or session.sought is not None

    def try_it(self, session: Session) -> None:
        """Let time run; go back to the start if it runs already."""
        if self.trying(session):
            self.back(session)
        elif not self.command("play", session):
            session.toggle()

    def back(self, session: Session) -> None:
        """Go back to the start, and to building; the run can be come back to."""
        if self.trying(session):
            self.trial.leave(session)
            session.restart()
            session.pause()
            session.forget_earlier()
        self._look_at(session)

    def come_back(self, session: Session) -> None:
        """Go on with the run of this level that was left."""
        if session.original is not self._played:
            self._take_up(session)
        if self.running:
            self.settle(session)
        if not self.refusal and self.trial.left(self.work.draft.text):
            self.trial.come_back(session, self.work.draft.text)
        self._look_at(session)

    def _look_at(self, session: Session) -> None:
        """Take up the run, or the level, whichever is shown; tools are those of that."""
        live = self.trial.live
        live.session = session
        bench = live if self.trying(session) else self.work
        if bench is self.bench:
            return
        while self.hand.busy:
            self.hand.cancel()
        self._stands = False
        chosen, self.bench = self.bench.selected, bench
        if bench is live:
            self.tool, self._laid_down = TOOLS[0].name, self.tool
            live.look()
            live.select(chosen)
        else:
            self.tool = self._laid_down
        self.show()

    def look(self, session: Session) -> None:
        """Take in where the run stands, before it is changed."""
        self._look_at(session)
        if self.bench is self.trial.live:
            self.trial.live.look()

    def undo(self, session: Session) -> None:
        """Take back the last change of the run; if there is none, the run, or one of the level."""
        if not self.trying(session):
            self.work.undo()
        elif self.trial.changed(session):
            self.trial.take_back(session)
            self.bench.tell(say("Undone: what was changed in the run"))
        else:
            self.back(session)
            self.work.tell(say("Undone: the run; Ctrl Y comes back to it"))

    def redo(self, session: Session) -> None:
        """Do again what was undone last: a change of the run, the run, or a change of the level."""
        if self.trying(session):
            try:
                done = self.trial.do_again(session)
            except SandboxError as error:
                self.bench.tell(say(error.message))
            else:
                self.bench.tell(say("Done again") if done else say("Nothing to redo"))
        elif self.trial.is_undone(self.work.draft.text):
            self.come_back(session)
        else:
            self.work.redo()

    def undoes(self, session: Session) -> str | None:
        """Return what would be undone next, in words."""
        if not self.trying(session):
            return self.work.draft.undoes
        if self.trial.changed(session):
            return say("the last change of the run")
        return say("the run")

    def redoes(self, session: Session) -> str | None:
        """Return what would be done again next, in words."""
        if self.trying(session):
            return say("change the run") if self.trial.is_taken_back(session) else None
        if self.trial.is_undone(self.work.draft.text):
            return say("the run")
        return self.work.draft.redoes

    def keep_run(self, session: Session) -> None:
        """Go on building with the present state of the run as a level of its own."""
        try:
            draft = self.trial.live.kept()
        except SandboxError as error:
            self.bench.tell(say(error.message))
            return
        self.begin(session, draft)
        self._look_at(session)
        self.work.tell(say(KEPT))

    def command(self, command: str, session: Session) -> bool:
        """Refuse to run what cannot; read a file again without losing what was changed."""
        if command in ("play", "step") and not self.trying(session):
            while self.hand.busy:
                self.hand.cancel()
            if self.running:
                self.settle(session)
            if self.refusal:
                self.work.tell(say("It cannot run yet: {reason}", reason=self.refusal))
            return bool(self.refusal)
        if command == "next field":
            return self.complete()
        if command == "reload":
            self.reload()
        return command == "reload"

    # the stage

    def key(self, event: pygame.event.Event, session: Session) -> bool:
        """Do what a key means while something is built, and return whether it means anything."""
        return keys.press(self, event, session)

    def process(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Let the tool in hand do what the mouse asks for."""
        self._look_at(session)
        self.bench.camera = stage.camera
        if self.bench is self.trial.live:
            return self._throw_in(event, area, stage, session)
        spot = self._spot = self._look((event.pos[0] - area.x, event.pos[1] - area.y))
        if event.type == pygame.MOUSEMOTION:
            self.hand.move(spot)
            return False  # with another button the view is moved
        if event.button == 1 and event.type == pygame.MOUSEBUTTONUP:
            self.hand.release(spot)
        elif event.button == 1 and area.collidepoint(event.pos):
            self.hand.press(spot)
        return bool(event.button == 1)

    def _throw_in(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Let a tool change the run; time stands until it is done. Without one the hand is back."""
        pixel, live = (event.pos[0] - area.x, event.pos[1] - area.y), self.trial.live
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == 1
        pressed = pressed and area.collidepoint(event.pos)
        if self.tool == TOOLS[0].name:
            if pressed:
                live.look()
                body = stage.body_at(pixel)
                part = ("bodies", body) if body else live.part_at(pixel)
                live.select([part] if part else ())
            return False
        if pressed:
            self._stands, session.playing = self._stands or session.playing, False
            live.look()
        spot = self._spot = self._look(pixel)
        if event.type == pygame.MOUSEMOTION:
            self.hand.move(spot)
        elif pressed:
            self.hand.press(spot)
        elif event.button == 1:
            self.hand.release(spot)
        self.go_on(session)
        return event.type != pygame.MOUSEMOTION and bool(event.button == 1)

    def go_on(self, session: Session) -> None:
        """Let time run again, once nothing is being drawn into the run."""
        if self._stands and not self.hand.busy:
            self._stands, session.playing = False, session.failure is None

    def _look(self, pixel: XY) -> Spot:
        """Return where the mouse is; while Alt is held nothing catches it."""
        free, held = self.bench.camera.to_world(pixel), pygame.key.get_mods()
        shift, loose = bool(held & pygame.KMOD_SHIFT), bool(held & pygame.KMOD_ALT)
        catch = partial(self.bench.snapping.point, in_line=self.tool == "join")
        return Spot(pixel, free, shift, loose, catch)

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw what is built, unless time runs."""
        work, camera = self.work, stage.camera
        work.camera = camera
        if self.trying(session):
            return False
        surface.blit(self._picture.of(work, pen), (0, 0))
        painting.draw_culprits(surface, work.sketch, self.culprits, camera)
        if self._spot is not None and self.tool not in ("select", "delete"):
            painting.caught(surface, camera, pen, self._spot.snapped)
        self.hand.draw(surface, pen)
        painting.draw_hint(surface, pen, say(self.hand.hint))
        return True

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw over the run what is selected in it, and what is being drawn into it."""
        if self.bench is not self.trial.live:
            return
        live, view = self.trial.live, stage.view
        for family, name in live.selected:
            if family == "bodies" and (outline := view.outlines.get(name)):
                corners = outline.placed(*view.state(outline))
                painting.draw_around(surface, stage.camera, corners, closed=outline.closed)
        if self.tool == TOOLS[0].name:
            return
        if self.hand.busy and self._spot is not None:
            painting.caught(surface, stage.camera, pen, self._spot.snapped)
        if live.fresh:
            self.hand.draw(surface, pen)
        message = say("{hint}; time stands still until then", hint=say(self.hand.hint))
        painting.draw_hint(surface, pen, message)
