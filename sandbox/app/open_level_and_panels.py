"""The contents of a window: the open level, or the error of opening it, and the panels."""

from collections.abc import Mapping
from pathlib import Path
from threading import Thread

import pygame

from sandbox.app.banner import Banner
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen, legible
from sandbox.app.files.preferences import WindowPreferences
from sandbox.app.frame_budget import Load
from sandbox.app.listed_levels import ListedLevels
from sandbox.app.malloc_tuning import give_back_gaps
from sandbox.app.mouse_on_stage import StageMouse
from sandbox.app.pages.page import OnStage
from sandbox.app.pages.register import PAGES, opening
from sandbox.app.pages.worker_registry import Workers
from sandbox.app.panels import refused_level, stage_messages
from sandbox.app.panels.all_panels import Panels
from sandbox.app.runs import run_file
from sandbox.app.runs.crash_recovery import LeftRun, RunRecovery
from sandbox.app.runs.remedy_search import RemedySearch
from sandbox.app.runs.session import Session
from sandbox.app.runs.settings_undo import UndoHistory
from sandbox.app.stage.stage import Stage
from sandbox.app.words import language
from sandbox.app.words.language import later, say
from sandbox.app.words.level_translation import title_of_level
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import without_links
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose, load
from sandbox.physics.measuring.recording import may_lean
from sandbox.physics.state.simulation_errors import SimulationError

TITLE = "Mechanics sandbox"
SIZE = (1280, 800)  # px

LONG = 60_000
"""A message announces that a level file above this size is being read [bytes]."""
MANY = 100
"""A message announces that a level with more bodies and joints than this is being built."""


class OpenLevelAndPanels:
    """A level, its picture, and all panels, on a surface."""

    def __init__(self, size: tuple[int, int] = SIZE) -> None:
        self.surface = _open_surface(size)
        """The surface on which everything is drawn."""
        self.session: Session | None = None
        """The session of the level; None if the level cannot be opened."""
        self.path: Path | None = None
        """The file of the level; None if it has none yet."""
        desktop = max((h for _, h in pygame.display.get_desktop_sizes()), default=0)
        self.comfort = WindowPreferences(desktop)
        """The user's preferences."""
        self._follow_preferences()
        self.pen = Pen(self.comfort.scale)
        """The pen that renders text."""
        self.stage = Stage(self.pen, size)
        """The picture of the level, with its camera."""
        self.hand = StageMouse(self.stage)
        """The mouse on the stage."""
        self.workers = Workers(PAGES)
        """The background work of the pages."""
        self.load = Load()
        """The time that frames take."""
        self.advising = RemedySearch()
        """The search for remedies."""
        self.panels = Panels(
            self.pen, size, self.workers, self.load, self.comfort, self.stage.shown
        )
        """The panels around the stage."""
        self.banner = Banner()
        """The message at the top of the stage."""
        self.help, self.sheets = 0, 1
        """The sheet of the help that is shown, 0 for none, and the number of sheets."""
        self.open = True
        """Whether the window is to stay open."""
        self.files = ListedLevels()
        """The list of levels."""
        self.undoing = UndoHistory()
        """The changes of the run that can be undone."""
        self.recovery = RunRecovery()
        """The file that keeps the run."""
        self._settings: Mapping[str, float] = {}
        self._accuracy: float | None = None  # requested when the level was opened
        self._refused: SandboxError | None = None
        self._refused_rate: float | None = None  # Hz, at which it could be opened
        self.lay_out()

    @property
    def stage_tool(self) -> OnStage | None:
        """The tool of the open page that replaces the hand on the stage, or None."""
        return self.workers.on_stage(self.panels.page) if self.panels.side is not None else None

    @property
    def advised(self) -> float | None:
        """The rate at which a level that has failed would succeed [Hz]; None if none is known."""
        return self.session.advised if self.session else self._refused_rate

    @property
    def empty(self) -> bool:
        """Whether there is neither a level nor a reason why it cannot be opened."""
        return self.session is None and self._refused is None

    def apply_preferences(self) -> None:
        """Apply preferences that have changed since the last call."""
        if self.comfort.chosen is self._followed:
            return
        self._follow_preferences()
        self.files.translate()
        self.pen.renew(self.comfort.scale)
        self.panels.renew(self.surface.size)
        if self.session is not None:
            self.stage.use(self.session.world)
            self._set_window_title(self.session.original)
        self.lay_out()

    def _follow_preferences(self) -> None:
        """Use the theme and the language that are preferred now."""
        self._followed = self.comfort.chosen
        theme.use(self._followed.theme)
        language.use(self.comfort.language)

    def lay_out(self) -> None:
        """Build everything around the stage for the current size of the window."""
        size = self.surface.size
        self.panels.build(size, self.files.entries, self.path, self.session, self._refused)
        self.stage.resize(self.panels.layout.stage.size)

    def open_level(
        self,
        level: str,
        settings: Mapping[str, float] | None = None,
        accuracy: float | None = None,
    ) -> None:
        """Open a level by its name or path, with options as for `open_file`; show any error."""
        try:
            path = without_links(level_catalog.find(level))
        except SandboxError as error:
            self._refuse(None, error)
            return
        self.open_file(path, settings or {}, accuracy)

    def open_file(
        self,
        path: Path,
        settings: Mapping[str, float] | None = None,
        accuracy: float | None = None,
        rate: float | None = None,
    ) -> None:
        """Open a level's file, or a run's file with its actions; if that fails, show the error.

        The settings, the accuracy and the rate [Hz] replace those of the level. The open level
        stays where it is if the file is not one that somebody would mend, such as a picture.
        """
        self.files.read_again(path)
        self.panels.home.leave()
        another, before = path != self.path, (self.path, self._settings, self._accuracy)
        self.path, self._settings, self._accuracy = path, settings or {}, accuracy
        ran = path.name.endswith(run_file.SUFFIX)
        try:
            session = run_file.open_run(path) if ran else self._session_of_file(path, rate)
        except SandboxError as error:
            if self.session is not None and (ran or path.suffix != ".json"):
                self.path, self._settings, self._accuracy = before
                self.banner.write(refused_level.in_brief(path, error))
                return
            self._refuse(path, error)
            self._refused_rate = error.rate if isinstance(error, SimulationError) else None
            return
        self._announce(session, path, ran=ran)
        self._show_session(session, another=another)

    def continue_run(self, left: LeftRun) -> None:
        """Go on with the run of an earlier window, paused where it was; show any error."""
        try:
            session = left.session()
        except SandboxError as error:
            self.banner.write(say(error.message))
            return
        self.panels.home.leave()
        self.path, self._settings, self._accuracy = None, {}, None
        self.banner.write(say("The run goes on where it was"))
        self._show_session(session, another=True)
        self.recovery.replace(left)

    def _show_session(self, session: Session, *, another: bool) -> None:
        """Show a session, perhaps of another level."""
        if self.session is not None:
            session.speed = self.session.speed
        self.session, self._refused = session, None
        self._world = session.world
        self.stage.use(session.world)
        self.stage.fit()
        if another:
            self.panels.show(opening(session.original, self.panels.page))
        self._set_window_title(session.original)
        self.lay_out()
        if session.world.scene.direct:
            from sandbox.physics.contacts.direct.complementarity.redundant_systems import preload

            Thread(target=preload, daemon=True).start()
        give_back_gaps()  # left by the previous level

    def _session_of_file(self, path: Path, rate: float | None) -> Session:
        """Return a session of a level's file; announce what will take long."""
        if path.is_file() and path.stat().st_size > LONG:
            self._show_at_once(say("Reading {file} …", file=path.name))
        level = self._read(path)
        parts = len(level.bodies) + len(level.joints)
        if parts > MANY:
            message = later("Building {title}: {count:,} bodies and joints …")
            self._show_at_once(say(message, title=legible(title_of_level(level)), count=parts))
        return Session(level, choose(level, self._settings), rate, patient=False)

    def _announce(self, session: Session, path: Path, *, ran: bool) -> None:
        """Announce what was opened, and remember the user's own files."""
        complaint = self.comfort.complaint()
        self.banner.write(complaint, lasting=bool(complaint))
        if ran:  # not a level's file, which is watched and written to
            self.path = None
            self.banner.write(say("{file} plays again, with all of your actions", file=path.name))
        else:
            self._remember(path)
        if may_lean(session.world):
            message = later("The solver's iterations do not settle this pile: it may lean or fall")
            self.banner.write(say(message))

    def _show_at_once(self, text: str) -> None:
        """Show a message at once, before a computation that delays the next frame."""
        area = self.panels.layout.stage
        stage_messages.draw_banner(self.surface, self.pen, area, text, theme.NOTICE)
        pygame.display.flip()

    def reload(self, rate: float | None = None) -> None:
        """Read the level's file again, with the same options, or at another rate [Hz]."""
        if self.path is not None:
            self.open_file(self.path, self._settings, self._accuracy, rate)

    def reload_changed(self, path: Path) -> None:
        """Reload a file that has changed; only show a message if that would undo user changes."""
        if self.session is None:
            self.reload()
            return
        try:
            same = self._read(path) == self.session.original
        except SandboxError:
            message = say("{file} has mistakes now; F5 shows them", file=path.name)
            self.banner.write(message, lasting=True)
            return
        if same:
            self.banner.write("")
        elif self.session.touched:
            message = say("{file} has changed; F5 reads it again", file=path.name)
            self.banner.write(message, lasting=True)
        else:
            self.reload()
            self.banner.write(say("{file} has changed and was read again", file=path.name))

    def run_as_advised(self) -> None:
        """Restart at the advised rate."""
        rate = self.advised
        if self.session is None:
            self.reload(rate)
        elif rate is not None:
            self.session.rerun(rate)
        if self.session is not None and rate is not None:
            message = later("now at {rate:,.0f} steps a second; F5 goes back to the level's own")
            self.banner.write(say(message, rate=rate))

    def follow(self, session: Session) -> None:
        """Show the session's world if it was rebuilt, perhaps from another file."""
        if session.shown is self._world:
            return
        self._world = session.shown
        self.stage.use(session.shown)
        path = _file(session.original)
        if path != self.path:
            self.path, self._settings, self._accuracy = path, {}, None
            if path is not None:
                self.files.read_again(path)
            self.stage.fit()
            self._set_window_title(session.original)
            self.lay_out()

    def go_home(self, at: Path | None = None) -> None:
        """Show the home page, scrolled to a level, by default the current one; or leave it.

        If it shows the results of a search, it then shows all levels instead.
        """
        home = self.panels.home
        if home.open and not self.panels.search_text:
            home.leave()
        else:
            home.enter(at or self.path)
            if self.session is not None:
                self.session.pause()
        self.panels.list_all()
        self.lay_out()

    def cancel(self) -> None:
        """Stop all background work."""
        self.workers.cancel()
        self.advising.cancel()
        self.panels.home.leave()

    def _read(self, path: Path) -> Level:
        """Return the level of a file, with the requested accuracy."""
        level = load(path)
        if self._accuracy is None:
            return level
        return level.model_copy(update={"stepping": Stepping(accuracy=self._accuracy)})

    def _refuse(self, path: Path | None, error: SandboxError) -> None:
        self.path, self._refused, self.session = path, error, None
        self._refused_rate = None
        pygame.display.set_caption(TITLE)
        self.cancel()
        if path is not None and path.suffix == ".json":
            self._remember(path)
        self.lay_out()

    def _remember(self, path: Path) -> None:
        """Add the user's own file to the recent ones."""
        if not path.is_relative_to(level_catalog.root()):
            self.banner.write(self.files.recent.add(path))

    @staticmethod
    def _set_window_title(level: Level) -> None:
        pygame.display.set_caption(f"{legible(title_of_level(level))} – {TITLE}")


def _open_surface(size: tuple[int, int]) -> pygame.Surface:
    """Open the surface of the window, in a size [px]."""
    pygame.display.init()
    pygame.font.init()
    pygame.display.set_caption(TITLE)
    return pygame.display.set_mode(size, pygame.RESIZABLE)


def _file(level: Level) -> Path | None:
    """Return the file of a level; None if it has none yet."""
    path = Path(level.source)
    return path if level.source and path.is_file() else None
