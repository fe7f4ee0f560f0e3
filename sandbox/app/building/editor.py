"""The editor: it takes the place of the hand while its page is open, and leads to the run and back.

What is built is drawn at its start, as its text says it. Once time runs the run is shown, and the
hand is back; to go back to the start is to go back to building.
"""

import re
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import pygame

from sandbox.app.building import keys, painting
from sandbox.app.building.drafts import Drafts
from sandbox.app.building.spot import Spot
from sandbox.app.building.tools.joining import JoinTool
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.building.tools.tool import Tool
from sandbox.app.building.work import Work
from sandbox.app.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.text import Pen
from sandbox.editing.draft import Draft
from sandbox.model.errors import SandboxError
from sandbox.model.shapes import XY
from sandbox.physics.state.errors import SimulationError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sandbox.model.level import Level

PATIENCE = 1.5
"""How long nothing is changed before the level is tried, as a multiple of what that takes."""


class Editor:
    """What the Build page finds out, does and shows; there is one a window.

    Attributes
    ----------
    work
        The level under edit.
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
    """

    def __init__(self) -> None:
        self.work, self.drafts = Work(), Drafts()
        self.tool = TOOLS[0].name
        self.refusal, self.naming = "", False
        self.culprits: frozenset[str] = frozenset()
        self._tools: Mapping[str, Tool] = {kind.name: kind.make(self.work) for kind in TOOLS}
        self._played: Level | None = None  # what the session has of it
        self._tried: object = self.work.version
        self._waits = 0.0  # s, until what was changed is tried
        self._cost = 0.0  # s, what that took last
        self._spot: Spot | None = None
        self._picture = painting.Picture()

    @property
    def news(self) -> object:
        """Another object whenever something else is to be shown."""
        return self.work.news

    def show(self) -> None:
        """Let the page be drawn anew."""
        self.work.news = object()

    @property
    def running(self) -> bool:
        """Whether something is still to be tried."""
        return self._tried is not self.work.version

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Keep to the level that is shown, and let the session play what was changed."""
        if watched and session.original is not self._played:
            self._take_up(session)
        if self.running:
            self._waits -= seconds
            if not watched or (self._waits <= 0 and not self.hand.busy):
                self.settle(session)
        if self.drafts.follow(self.work.draft, seconds):
            self.show()
        return self.work.told()

    def cancel(self) -> None:
        """Keep what is not saved for the next time."""
        self.drafts.keep()

    def _take_up(self, session: Session) -> None:
        """Edit the level that is shown; what was not saved of it is still there."""
        draft = self.drafts.of(session.original)
        self.work.take(draft)
        self._played, self._tried = session.original, self.work.version
        self.refusal, self.culprits = "", frozenset()
        if draft.text != session.original.text:
            self.work.tell("What you have changed is still here, and not saved")
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
            work.tell(f"That cannot be: {work.mistake}")
            while level is None and work.draft.undo():
                level = work.draft.level
            work.refresh()
        self._tried = work.version
        self.show()
        self.refusal, self.culprits = "", frozenset()
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
        self.refusal = str(error)
        if isinstance(error, SimulationError):
            self.refusal = f"{error.reason}; {error.hint}" if error.hint else error.reason
            sketch = self.work.sketch
            named = {error.subject, *re.findall(r"'(\w+)'", error.reason)}
            self.culprits = frozenset(n for n in named if n in sketch.bodies or n in sketch.joints)

    # the tool in hand

    @property
    def hand(self) -> Tool:
        """The tool in hand."""
        return self._tools[self.tool]

    @property
    def joining(self) -> JoinTool:
        """The tool that makes joints."""
        tool = self._tools["join"]
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
        elif self.work.selected:
            self.work.select(())
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
            self.work.tell(str(error))
            return
        self.naming, self._tried = False, None  # its level has another place now
        self.work.tell(f"Saved {draft.path}")

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
            self.work.tell(str(error))
            return
        self.drafts.outside = False
        self.work.refresh()
        self.work.tell("Read again; Ctrl+Z brings back what was here before")

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
        """Go back to the start, and to building."""
        if self.trying(session):
            session.restart()
            session.pause()
            session.forget_earlier()
            self.show()

    def command(self, command: str, session: Session) -> bool:
        """Refuse to run what cannot; read a file again without losing what was changed."""
        if command in ("play", "step") and not self.trying(session):
            while self.hand.busy:
                self.hand.cancel()
            if self.running:
                self.settle(session)
            if self.refusal:
                self.work.tell(f"It cannot run yet: {self.refusal}")
            return bool(self.refusal)
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
        self.work.camera = stage.camera
        if self.trying(session):
            return False
        spot = self._spot = self._look((event.pos[0] - area.x, event.pos[1] - area.y))
        if event.type == pygame.MOUSEMOTION:
            self.hand.move(spot)
            return False  # with another button the view is moved
        if event.button == 1 and event.type == pygame.MOUSEBUTTONUP:
            self.hand.release(spot)
        elif event.button == 1 and area.collidepoint(event.pos):
            self.hand.press(spot)
        return bool(event.button == 1)

    def _look(self, pixel: XY) -> Spot:
        """Return where the mouse is; while Alt is held nothing catches it."""
        free, held = self.work.camera.to_world(pixel), pygame.key.get_mods()
        shift, loose = bool(held & pygame.KMOD_SHIFT), bool(held & pygame.KMOD_ALT)
        return Spot(pixel, free, shift, loose, self.work.snapping.point)

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw what is built, unless time runs."""
        work, camera = self.work, stage.camera
        work.camera = camera
        if self.trying(session):
            return False
        surface.blit(self._picture.of(work, pen), (0, 0))
        painting.draw_selected(surface, work.sketch, work.selected, camera)
        painting.draw_culprits(surface, work.sketch, self.culprits, camera)
        if self._spot is not None and self.tool not in ("select", "delete"):
            painting.caught(surface, camera, pen, self._spot.snapped)
        self.hand.draw(surface, pen)
        painting.draw_hint(surface, pen, self.hand.hint)
        return True
