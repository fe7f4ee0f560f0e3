"""The window: events in, frames out."""

import gc
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from time import perf_counter

import pygame

from sandbox.app import legend, probe, theme
from sandbox.app.advising import Advising
from sandbox.app.banner import Banner
from sandbox.app.commands import command
from sandbox.app.hand import Hand
from sandbox.app.keys import AT_HOME, WHILE_TYPING
from sandbox.app.load import Load
from sandbox.app.pages.page import Desk, OnStage, PageCommand
from sandbox.app.pages.register import PAGES, opening, page, runs_beside
from sandbox.app.pages.workers import Workers
from sandbox.app.panels import levels, messages
from sandbox.app.panels.layout import ROOM
from sandbox.app.panels.panels import Panels
from sandbox.app.preferences import Comfort
from sandbox.app.recent import Recent
from sandbox.app.session import Session
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.stage.stage import Stage
from sandbox.app.text import Pen, legible
from sandbox.app.watching import FileWatch
from sandbox.app.widgets.opening import SMALLEST
from sandbox.app.widgets.parameters import Change
from sandbox.model import catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose, load
from sandbox.physics.state.errors import SimulationError

TITLE = "Mechanics sandbox"
SIZE = (1280, 800)  # px
RATE = 60  # frames a second
QUIET_RATE = 20  # frames a second while nothing happens
QUIET = 1.0  # s without an event, after which nothing happens
LONGEST_FRAME = 0.1  # s; what is missed beyond is not made up for


class Window:
    """The desktop app. `run` it, or drive it `frame` by `frame`.

    Attributes
    ----------
    surface
        What is shown.
    session
        The level that is played; None if it cannot be opened.
    stage
        The picture of it, and its camera.
    panels
        What stands around it.
    hand
        What the mouse does on it.
    open
        Whether the window is still wanted.
    """

    def __init__(self, size: tuple[int, int] = SIZE) -> None:
        pygame.display.init()
        pygame.font.init()
        pygame.display.set_caption(TITLE)
        self.surface = pygame.display.set_mode(size, pygame.RESIZABLE)
        self.open = True
        self.session: Session | None = None
        self._comfort = Comfort(max((h for _, h in pygame.display.get_desktop_sizes()), default=0))
        self._followed = self._comfort.chosen
        theme.use(self._followed.theme)
        self._pen = Pen(self._comfort.scale)
        self.stage = Stage(self._pen, size)
        self.hand = Hand(self.stage)
        self.workers, self._load = Workers(PAGES), Load()
        self.advising = Advising()
        self.panels = Panels(self._pen, size, self.workers, self._load, self._comfort)
        self._recent = Recent()
        opened = (levels.entry(path, "opened") for path in self._recent.paths)
        self._entries = [*opened, *levels.entries()]
        self._path: Path | None = None
        self._settings: Mapping[str, float] = {}
        self._accuracy: float | None = None  # that was asked for when it was opened
        self._refused: SandboxError | None = None
        self._watch = FileWatch()
        self._advised: float | None = None  # the rate for a level that cannot be opened [Hz]
        self._banner = Banner()
        self._help = False
        self._quiet = 0.0  # s since the last event
        self._commands = self._make_commands()
        self._lay_out()

    def _make_commands(self) -> Mapping[str, Callable[[], None]]:
        stage = self.stage
        return {
            "play": lambda: self._with_session(Session.toggle),
            "step": lambda: self._with_session(Session.step),
            "step back": lambda: self._with_session(Session.step_back),
            "restart": self._restart,
            "faster": lambda: self._with_session(Session.faster),
            "slower": lambda: self._with_session(Session.slower),
            "next level": lambda: self._neighbour(1),
            "previous level": lambda: self._neighbour(-1),
            "page down": lambda: self._turn(0.5),
            "page up": lambda: self._turn(-0.5),
            "reload": self._reload,
            "fit": lambda: self._with_session(lambda _: stage.fit()),
            "zoom in": lambda: stage.camera.zoom(1.25),
            "zoom out": lambda: stage.camera.zoom(0.8),
            "levels": lambda: self._toggle_column("levels"),
            "panel": lambda: self._toggle_column("side"),
            "energy": self._toggle_graph,
            "next field": self._next_field,
            "find": self._find,
            "larger": lambda: self._banner.tell(self._comfort.resize(1)),
            "smaller": lambda: self._banner.tell(self._comfort.resize(-1)),
            "usual size": lambda: self._banner.tell(self._comfort.choose(size=None)),
            "next theme": lambda: self._banner.tell(self._comfort.next_theme()),
            "help": self._toggle_help,
            "leave": self._leave,
            **{each.name: partial(self._switch, each.name) for each in OVERLAYS},
            "home": self._go_home,
            "open file": self._ask_for_file,
            **self._page_commands(),
        }

    def _go_home(self) -> None:
        """Show the levels as cards, or the stage again."""
        home = self.panels.home
        if home.open:
            home.leave()
        else:
            home.enter(self._path)
            self._with_session(Session.pause)
        self._lay_out()

    def _ask_for_file(self) -> None:
        """Let a person choose a file of their own, at first where the last one was."""
        if any(have < least for have, least in zip(self.surface.size, SMALLEST, strict=True)):
            least = " × ".join(map(str, SMALLEST))
            self._banner.tell(f"Make the window larger for that: {least} px are enough.")
            return
        last = self._recent.paths[0].parent if self._recent.paths else Path.home()
        self.panels.ask_for_file(last)

    def _page_commands(self) -> Mapping[str, Callable[[], None]]:
        """Return what opens the pages, and what they understand."""
        opening = {page.command: partial(self._turn_to, page.command) for page in PAGES}
        acting = {
            each.name: partial(self._act_on, page.command, each)
            for page in PAGES
            for each in page.commands
        }
        return {**opening, **acting}

    def open_level(
        self,
        level: str,
        settings: Mapping[str, float] | None = None,
        accuracy: float | None = None,
    ) -> None:
        """Open a level by its name or path, with an accuracy that is asked for, if one is.

        If it cannot be opened, say why.
        """
        try:
            path = catalog.find(level).resolve()
        except SandboxError as error:
            self._refuse(None, error)
            return
        self._open(path, settings or {}, accuracy)

    @property
    def _maker(self) -> OnStage | None:
        """What is in the place of the hand for the page that is open; None if nothing is."""
        return self.workers.on_stage(self.panels.page) if self.panels.side is not None else None

    def _switch(self, overlay: str) -> None:
        """Draw an overlay from now on, or draw it no more."""
        self.stage.shown[overlay] = not self.stage.shown[overlay]

    def do(self, command: str) -> None:
        """Do what a command asks for, as its key does: beside the cards, or at the stage."""
        maker = self._maker
        if self.panels.home.open and command not in AT_HOME:
            self._go_home()
        if maker is None or self.session is None or not maker.command(command, self.session):
            self._commands[command]()

    def _open(
        self,
        path: Path,
        settings: Mapping[str, float],
        accuracy: float | None = None,
        rate: float | None = None,
    ) -> None:
        self._list(path)
        self.panels.home.leave()
        another = path != self._path
        self._path, self._settings, self._accuracy = path, settings, accuracy
        try:
            level = self._read(path)
            session = Session(level, choose(level, settings), rate, patient=False)
        except SandboxError as error:
            self._refuse(path, error)
            self._advised = error.rate if isinstance(error, SimulationError) else None
            return
        if self.session is not None:
            session.speed = self.session.speed
        self.session, self._refused = session, None
        self._banner.tell("")
        self._remember(path)
        self._world = session.world
        self.stage.use(session.world)
        self.stage.fit()
        if another:
            self.panels.show(opening(level, self.panels.page))
        self._entitle(level)
        self._lay_out()

    def _read(self, path: Path) -> Level:
        """Return the level of a file, with the accuracy that was asked for."""
        level = load(path)
        if self._accuracy is None:
            return level
        return level.model_copy(update={"stepping": Stepping(accuracy=self._accuracy)})

    def _read_again(self, path: Path) -> None:
        """Show a file that has changed, or say so where that would undo what a person did."""
        if self.session is None:
            self._reload()
            return
        try:
            same = self._read(path) == self.session.original
        except SandboxError:
            self._banner.tell(f"{path.name} has mistakes now; F5 shows them", lasting=True)
            return
        if same:
            self._banner.tell("")
        elif self.session.touched:
            self._banner.tell(f"{path.name} has changed; F5 reads it again", lasting=True)
        else:
            self._reload()
            self._banner.tell(f"{path.name} has changed and was read again")

    @staticmethod
    def _entitle(level: Level) -> None:
        pygame.display.set_caption(f"{legible(level.title)} – {TITLE}")

    def _list(self, path: Path) -> None:
        """Let the list of levels say what a file is called now."""
        for i, entry in enumerate(self._entries):
            if entry.path == path:
                self._entries[i] = levels.entry(path, entry.chapter)
                return
        self._entries.insert(0, levels.entry(path, "opened"))

    def _remember(self, path: Path) -> None:
        """Keep a file that is not one of the catalogue among those that were opened."""
        if not path.is_relative_to(catalog.root()):
            self._banner.tell(self._recent.add(path))

    def _refuse(self, path: Path | None, error: SandboxError) -> None:
        self._path, self._refused, self.session = path, error, None
        self._advised = None
        pygame.display.set_caption(TITLE)
        self.workers.cancel()
        self.advising.cancel()
        self.panels.home.leave()
        if path is not None and path.suffix == ".json":
            self._remember(path)
        self._lay_out()

    def _follow_comfort(self) -> None:
        """Look as a person has chosen since the last frame."""
        chosen = self._comfort.chosen
        if chosen is self._followed:
            return
        self._followed = chosen
        theme.use(chosen.theme)
        self._pen.renew(self._comfort.scale)
        self.panels.renew(self.surface.size)
        if self.session is not None:
            self.stage.use(self.session.world)
        self._lay_out()

    def _lay_out(self) -> None:
        """Build everything around the stage for the window as large as it is now."""
        size = self.surface.size
        self.panels.build(size, self._entries, self._path, self.session, self._refused)
        self.stage.resize(self.panels.layout.stage.size)

    def run(self) -> None:
        """Show frames until the window is closed."""
        gc.collect()
        gc.freeze()  # to look through all that is there by now, for what is lost, takes two frames
        clock, before = pygame.time.Clock(), perf_counter()
        while self.open:
            clock.tick(RATE if self._busy else QUIET_RATE)
            now = perf_counter()
            self.frame(min(now - before, LONGEST_FRAME))
            before = now
            pygame.display.flip()

    @property
    def _busy(self) -> bool:
        playing = self.session is not None and self.session.playing
        return playing or self._quiet < QUIET or self.workers.running or self.advising.running

    def frame(self, seconds: float) -> None:
        """Handle what has happened, let time pass, and draw."""
        events = pygame.event.get()
        self._quiet = 0.0 if events else self._quiet + seconds
        for event in events:
            self._handle(event)
        self._follow_comfort()
        if self._watch.changed(self._path, seconds) and self._path is not None:
            self._read_again(self._path)
        if self.session is not None:
            self.advising.follow(self.session)
        self.panels.advise(self.session.advised if self.session else self._advised)
        self.panels.manager.update(seconds)
        self._banner.update(seconds)
        if self.session is not None:
            self._leave_fields()
            self._play(self.session, seconds)
            for text in self.workers.follow(self.session, seconds, self.panels.page):
                self._banner.tell(text)
            self._follow(self.session)
        if self.panels.home.open:
            self.panels.follow_home()
        begun = perf_counter()
        if self.panels.side is not None:
            self.panels.side.update(seconds)
        self.panels.controls.update(self.session, self.stage.shown)
        self._draw()
        self._load.drew(perf_counter() - begun)

    def _play(self, session: Session, seconds: float) -> None:
        """Let time pass, and note what that takes."""
        world, hooks, begun = session.world, session.world.kicks.seconds, perf_counter()
        session.update(seconds)
        if session.playing:
            self._load.stepped(perf_counter() - begun, world.kicks.seconds - hooks)

    def close(self) -> None:
        """End what works for the window."""
        self.workers.cancel()
        self.advising.cancel()
        self.panels.home.leave()

    def _follow(self, session: Session) -> None:
        """Show the session's world, if it has been built anew, maybe from another file."""
        if session.world is self._world:
            return
        self._world = session.world
        self.stage.use(session.world)
        path = _file(session.original)
        if path != self._path:
            self._path, self._settings, self._accuracy = path, {}, None
            if path is not None:
                self._list(path)
            self.stage.fit()
            self._entitle(session.original)
            self._lay_out()

    def _handle(self, event: pygame.event.Event) -> None:
        if event.type == pygame.QUIT:
            self.open = False
        elif event.type == pygame.VIDEORESIZE:
            self.surface = pygame.display.get_surface() or self.surface
            self._lay_out()
        elif event.type == pygame.DROPFILE:
            self.open_level(event.file)
        elif self._change(event):
            return
        elif event.type == pygame.KEYDOWN:
            self._key(event)
        elif not self.panels.manager.process_events(event) and not self._at_home(event):
            self._click(event)

    def _at_home(self, event: pygame.event.Event) -> bool:
        """Give an event to the cards, if they are shown, and return whether it was for them."""
        home = self.panels.home
        if not home.open or self.panels.dialog is not None or not home.process(event):
            return False
        if home.chosen is not None:
            path, home.chosen = home.chosen, None
            self._open(path, {})
        return True

    def _key(self, event: pygame.event.Event) -> None:
        if not self.panels.typing and self._at_home(event):
            return
        chosen, maker, session = command(event), self._maker, self.session
        free = not (self.panels.typing or self._help or self.panels.home.open)
        if free and maker is not None and session is not None and maker.key(event, session):
            return
        if chosen and (not self.panels.typing or chosen in WHILE_TYPING):
            self.do(chosen)
        else:
            self.panels.manager.process_events(event)

    def _click(self, event: pygame.event.Event) -> None:
        """Give an event to the list, to the controls, or to the stage."""
        if path := self.panels.wanted(event):
            self._open(path.resolve(), {})
        elif self.panels.accepts(event):
            self._run_as_advised()
        elif chosen := self.panels.pressed(event):
            self.do(chosen)
        elif self._seek(event) or self._click_side(event):
            return
        elif self.session is not None:
            self._touch(event, self.session)

    def _touch(self, event: pygame.event.Event, session: Session) -> None:
        """Give an event of the mouse to what makes something on the stage, or to the hand."""
        mouse, area, maker = pygame.mouse.get_pos(), self.panels.layout.stage, self._maker
        if event.type == pygame.MOUSEWHEEL and area.collidepoint(mouse):
            self.hand.wheel(event.precise_y, mouse, area)
        elif event.type in _MOUSE and not (
            maker is not None and maker.process(event, area, self.stage, session)
        ):
            self.hand.process(event, area, session)

    def _seek(self, event: pygame.event.Event) -> bool:
        """Go to the time that was clicked on or dragged to, and return whether one was."""
        share = self.panels.controls.sought(event)
        if share is None or self.session is None:
            return share is not None
        try:
            self.session.go_to(round(share * self.session.end))
        except SandboxError as error:
            self._banner.tell(str(error))
        return True

    def _run_as_advised(self) -> None:
        """Run again at the rate that was offered."""
        rate = self.session.advised if self.session else self._advised
        if self.session is None and self._path is not None:
            self._open(self._path, self._settings, self._accuracy, rate)
        elif self.session is not None and rate is not None:
            self.session.rerun(rate)
        if self.session is not None and rate is not None:
            self._banner.tell(f"now at {rate:,.0f} steps a second; F5 goes back to the level's own")

    def _click_side(self, event: pygame.event.Event) -> bool:
        """Give an event to the side panel, and return whether it was for that."""
        side = self.panels.side
        if side is None:
            return False
        if wanted := side.process(event):
            self.do(wanted)
            return True
        told = side.act(event)
        if told is not None:
            self._banner.tell(told)
        return told is not None

    def _change(self, event: pygame.event.Event) -> bool:
        side = self.panels.side
        change = side.parameters.process(event) if side is not None else None
        if change is not None:
            self._set(change)
        return change is not None

    def _leave_fields(self) -> None:
        """Take what was typed into a field that has been left."""
        side = self.panels.side
        if side is not None and (change := side.parameters.left()):
            self._set(change)

    def _set(self, change: Change) -> None:
        """Change a parameter, from the start or from now on; what cannot be is told."""
        assert self.session is not None
        assert self.panels.side is not None
        if change.value is None:
            self._banner.tell(f"'{change.typed}' is not a number")
        elif change.value != self.session.values[change.name]:
            try:
                self.session.change({change.name: change.value}, otherwise=change.shifted)
                self._banner.tell("")
            except SandboxError as error:
                self._banner.tell(str(error))
        self.panels.side.parameters.show(self.session.values)
        self.panels.side.parameters.revert()

    def _with_session(self, act: Callable[[Session], None]) -> None:
        if self.session is not None:
            act(self.session)

    def _restart(self) -> None:
        if self.session is None:
            self._reload()
        else:
            self.session.restart()

    def _reload(self) -> None:
        if self._path is not None:
            self._open(self._path, self._settings, self._accuracy)

    def _neighbour(self, direction: int) -> None:
        paths = [entry.path for entry in self._entries]
        if not paths:
            return
        here = paths.index(self._path) if self._path in paths else -min(direction, 0)
        self._open(paths[(here + direction) % len(paths)], {})

    def _toggle_column(self, name: str) -> None:
        if self._has_room(name):
            self.panels.hide_or_show(name)
            self._lay_out()

    def _has_room(self, column: str) -> bool:
        """Whether the window is wide enough for a column; if it is not, say so."""
        enough = self.surface.width >= ROOM[column]
        if not enough:
            self._banner.tell(f"Make the window wider for that: {ROOM[column]} px are enough.")
        return enough

    def _toggle_graph(self) -> None:
        self.panels.graph = not self.panels.graph
        self._lay_out()

    def _turn_to(self, page: str) -> None:
        """Show a page of the side panel, also where that was hidden."""
        if self._has_room("side"):
            self.panels.show(page)
            self._lay_out()

    def _act_on(self, page: str, asked: PageCommand) -> None:
        """Do what a page is asked for, and show it."""
        if self.session is None:
            return
        self._turn_to(page)
        try:
            told = asked.act(Desk(self.session, self.workers.all, self._load, self._comfort))
        except SandboxError as error:
            told = str(error)
        if told is not None:
            self._banner.tell(told)

    def _find(self) -> None:
        """Look for a level, also where the list of them was hidden."""
        if self.panels.list is None:
            self._toggle_column("levels")
        self.panels.seek()

    def _next_field(self) -> None:
        if self.panels.side is not None:
            backwards = pygame.key.get_mods() & pygame.KMOD_SHIFT
            self.panels.side.focus(-1 if backwards else 1)

    def _turn(self, pages: float) -> None:
        self.panels.turn(pages)

    def _toggle_help(self) -> None:
        self._help = not self._help

    def _leave(self) -> None:
        """Close the help, let go of a field, show all levels, put the tape away; else quit."""
        if self._help:
            self._help = False
        elif self.panels.typing or self.panels.sought:
            self.panels.let_go()
        elif self.panels.home.open and (self.session or self._refused):
            self._go_home()
        elif self.hand.tape is not None:
            self.hand.tape = None
        else:
            self.open = False

    def _draw(self) -> None:
        layout, surface = self.panels.layout, self.surface
        area = layout.stage.clip(surface.get_rect())
        if self.panels.home.open:
            self.panels.home.draw(surface)
            self._banner.draw(surface, self._pen, layout.stage, None)
        elif self.session is not None and area:
            view = surface.subsurface(area)
            session, maker = self.session, self._maker
            if maker is None or not maker.draw(view, self.stage, self._pen, session):
                self._draw_run(view, session)
            if self.hand.tape is not None:
                self.hand.tape.draw(view, self.stage.camera, self._pen)
            told = self._banner.draw(surface, self._pen, layout.stage, session)
            runs = runs_beside(session)[1] or legend.earlier([r.told for r in session.earlier])
            legend.draw(view, self._pen, runs, told)
        else:
            surface.fill(theme.STAGE, layout.stage)
        for column in (layout.levels, layout.side):
            surface.fill(theme.PANEL, column)
        self.panels.controls.draw(surface, self.session)
        self.panels.manager.draw_ui(surface)
        for x in (layout.stage.left, layout.stage.right - 1):
            surface.fill(theme.EDGE, (x, 0, 1, layout.stage.height))
        if self._help:
            rows = page(self.panels.page).keys if self._maker is not None else ()
            messages.draw_help(surface, self._pen, layout.stage, rows or messages.everywhere())

    def _draw_run(self, view: pygame.Surface, session: Session) -> None:
        self.stage.view.looking = session.looking
        side = self.panels.side is not None
        self.stage.asked = page(self.panels.page).overlay if side else ""
        earlier = [run.trail for run in session.earlier]
        self.stage.draw(view, session.trail, session.milestones(), session.companions, earlier)
        x, y = pygame.mouse.get_pos()
        left, top = self.panels.layout.stage.topleft
        probe.draw(view, self.stage.view, session, (x - left, y - top))


def _file(level: Level) -> Path | None:
    """Return the file that a level was read from; None if it has none yet."""
    path = Path(level.source)
    return path if level.source and path.is_file() else None


_MOUSE = (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION)
