"""The actions of all commands: those of the window, of its pages, and of its overlays.

The keys of the commands are in `keymap`.
"""

import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import pygame

from sandbox.app.files import save_folder
from sandbox.app.open_level_and_panels import OpenLevelAndPanels
from sandbox.app.pages.page import Desk, PageCommand
from sandbox.app.pages.register import PAGES
from sandbox.app.pages.table.stopwatch import Stopwatch
from sandbox.app.panels.verdicts_and_energies import FIRST, NEXT
from sandbox.app.panels.window_layout import room
from sandbox.app.runs.session import Session
from sandbox.app.stage import level_labels
from sandbox.app.stage.frame_of_reference import CENTER
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.widgets.file_dialog import SMALLEST
from sandbox.app.window_keys import AT_HOME
from sandbox.app.words.language import say
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError


class CommandActions:
    """Executes commands by name, for keys and buttons."""

    def __init__(self, workspace: OpenLevelAndPanels) -> None:
        self._space = workspace
        self._acts: Mapping[str, Callable[[], None]] = {
            **self._run_commands(),
            **self._view_commands(),
            **self._window_commands(),
            **self._appearance_commands(),
            **{each.name: partial(self._toggle_overlay, each.name) for each in OVERLAYS},
            **self._page_commands(),
        }
        self.names = frozenset(self._acts)
        """The names of all commands."""

    def do(self, command: str) -> None:
        """Execute a command; one that does not work on the home page first closes that."""
        space, maker = self._space, self._space.stage_tool
        if space.panels.home.open and command not in AT_HOME:
            space.go_home()
        if maker is None or space.session is None or not maker.command(command, space.session):
            self._acts[command]()

    def _run_commands(self) -> Mapping[str, Callable[[], None]]:
        return {
            "play": partial(self._with_session, Session.toggle),
            "step": partial(self._with_session, Session.step),
            "step back": partial(self._with_session, Session.step_back),
            "impact before": partial(
                self._with_session, partial(Session.go_to_impact, direction=-1)
            ),
            "impact after": partial(self._with_session, partial(Session.go_to_impact, direction=1)),
            "faster": partial(self._with_session, Session.faster),
            "slower": partial(self._with_session, Session.slower),
            "restart": self._restart,
            "stopwatch": self._press_the_stopwatch,
            "reload": self._space.reload,
            "undo": partial(self._undo_in_run, again=False),
            "redo": partial(self._undo_in_run, again=True),
            "next level": partial(self._go_to_neighbour, 1),
            "previous level": partial(self._go_to_neighbour, -1),
        }

    def _view_commands(self) -> Mapping[str, Callable[[], None]]:
        stage, panels = self._space.stage, self._space.panels
        return {
            "fit": partial(self._with_session, lambda _: stage.fit()),
            "observe": partial(self._with_session, self._observe),
            "zoom in": lambda: stage.camera.zoom(1.25),
            "zoom out": lambda: stage.camera.zoom(0.8),
            "levels": partial(self._toggle_column, "levels"),
            "panel": partial(self._toggle_column, "side"),
            "checks": self._show_checks,
            "energy": self._show_energy_otherwise,
            "next page": partial(self._open_page_further_on, 1),
            "previous page": partial(self._open_page_further_on, -1),
            "page down": partial(panels.scroll_pages, 0.5),
            "page up": partial(panels.scroll_pages, -0.5),
        }

    def _window_commands(self) -> Mapping[str, Callable[[], None]]:
        return {
            "next field": self._next_field,
            "find": self._find,
            "help": self._show_help,
            "leave": self._close_first_open,
            "home": self._space.go_home,
            "challenges": self._show_challenges,
            "open file": self._ask_for_file,
        }

    def _appearance_commands(self) -> Mapping[str, Callable[[], None]]:
        comfort = self._space.comfort
        return {
            "larger": lambda: self._show_note(comfort.resize(1)),
            "smaller": lambda: self._show_note(comfort.resize(-1)),
            "usual size": lambda: self._show_note(comfort.choose(size=None)),
            "next theme": lambda: self._show_note(comfort.next_theme()),
        }

    def _page_commands(self) -> Mapping[str, Callable[[], None]]:
        """Return the commands that open pages, and the pages' own commands."""
        opening = {page.command: partial(self.open_page, page.command) for page in PAGES}
        acting = {
            each.name: partial(self._execute_on_page, page.command, each)
            for page in PAGES
            for each in page.commands
        }
        return {**opening, **acting}

    def _with_session(self, act: Callable[[Session], None]) -> None:
        if self._space.session is None:
            return
        try:
            act(self._space.session)
        except SandboxError as error:
            self._show_note(say(error.message))

    def _observe(self, session: Session) -> None:
        """See it from the selected body, then from the centre of mass, then from the ground."""
        looking = session.looking
        places = [looking.body(session.level), CENTER, None]
        is_known = looking.seen_from in places
        looking.seen_from = places[(places.index(looking.seen_from) + 1) % 3 if is_known else 0]
        self._show_note("" if looking.seen_from is not None else level_labels.seen_from(None))

    def _press_the_stopwatch(self) -> None:
        if self._space.session is not None:
            message = self._space.workers.of(Stopwatch).press(self._space.session)
            if message is not None:
                self._show_note(message)

    def _restart(self) -> None:
        if self._space.session is None:
            self._space.reload()
        else:
            self._space.session.restart()

    def _undo_in_run(self, *, again: bool) -> None:
        """Undo or redo the last change of the run; the editor has its own undo."""
        space = self._space
        if space.session is None or space.stage_tool is not None:
            return
        again = again or bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
        try:
            act = space.undoing.redo if again else space.undoing.undo
            self._show_note(act(space.session))
        except SandboxError as error:
            self._show_note(say(error.message))

    def _go_to_neighbour(self, direction: int) -> None:
        path = self._space.files.neighbour(self._space.path, direction)
        if path is not None:
            self._space.open_file(path)

    def _toggle_overlay(self, overlay: str) -> None:
        """Show or hide an overlay."""
        shown = self._space.stage.shown
        shown[overlay] = not shown[overlay]

    def _toggle_column(self, name: str) -> None:
        if self._has_room(name):
            self._space.panels.hide_or_show(name)
            self._space.lay_out()

    def _has_room(self, column: str) -> bool:
        """Whether the window is wide enough for a column; if not, show a note."""
        least, enough = self._least_width(column), self._fits(column)
        if not enough:
            self._show_note(
                say("Make the window wider for that: {least} px are enough.", least=least)
            )
        return enough

    def _fits(self, column: str) -> bool:
        """Whether the window is wide enough for a column."""
        return self._space.surface.width >= self._least_width(column)

    def _least_width(self, column: str) -> int:
        """Return the least width of the window with a column [px]."""
        return room(column, self._space.pen.scale, beside=self._space.panels.side is not None)

    def _show_checks(self) -> None:
        """Show the checks on the level's own page."""
        self.open_page(PAGES[0].command)
        if self._space.panels.side is not None:
            self._space.panels.side.show_checks()

    def _show_energy_otherwise(self) -> None:
        panels = self._space.panels
        foot = panels.side.foot if panels.side is not None else None
        panels.energy = NEXT[foot.view if foot else panels.energy or FIRST][0]
        self._space.lay_out()

    def open_page(self, page: str) -> None:
        """Show a page of the side panel, and the panel itself if it was hidden."""
        if self._has_room("side"):
            self._space.panels.show(page)
            self._space.lay_out()

    def _open_page_further_on(self, by: int) -> None:
        """Show the page some tabs further on, cyclically."""
        pages = [page.command for page in PAGES]
        self.open_page(pages[(pages.index(self._space.panels.page) + by) % len(pages)])

    def _execute_on_page(self, page: str, command: PageCommand) -> None:
        """Show a page and execute one of its commands."""
        space = self._space
        if space.session is None:
            return
        self.open_page(page)
        try:
            window_state = space.workers.of, space.load, space.comfort, space.stage.shown
            answer = command.act(Desk(space.session, *window_state))
        except SandboxError as error:
            answer = say(error.message)
        if answer is not None:
            self._show_note(answer)

    def _next_field(self) -> None:
        self._space.panels.move_focus(-1 if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1)

    def _find(self) -> None:
        """Focus the search for levels, and show the list if it was hidden.

        In a window that is too narrow for the list beside the panel, go to the home page.
        """
        panels = self._space.panels
        if panels.list is None and not panels.home.open and not self._fits("levels"):
            self._space.go_home()
        if panels.list is None:
            self._toggle_column("levels")
        panels.seek()

    def _show_challenges(self) -> None:
        """Show the home page, scrolled to the challenges."""
        entries = self._space.files.entries
        first = next(
            (each.path for each in entries if each.chapter == level_catalog.CHALLENGES), None
        )
        self._space.panels.home.leave()
        self._space.go_home(first)

    def _ask_for_file(self) -> None:
        """Ask for a level's file, in the folder of the last one, or else of what is saved."""
        size = self._space.surface.size
        if any(have < least for have, least in zip(size, SMALLEST, strict=True)):
            least = " × ".join(map(str, SMALLEST))
            self._show_note(
                say("Make the window larger for that: {least} px are enough.", least=least)
            )
            return
        last = [path.parent for path in self._space.files.recent.paths[:1]]
        places = (*last, save_folder.folder(), Path.home())
        self._space.panels.ask_for_file(next(filter(os.path.isdir, places), places[-1]))

    def _show_help(self) -> None:
        """Show the next sheet of the help; close it after the last."""
        self._space.help = (self._space.help + 1) % (self._space.sheets + 1)

    def _close_first_open(self) -> None:
        """Close the first of help, widget, search or measurement that is open; else quit."""
        space = self._space
        stopwatch = space.workers.of(Stopwatch)
        if space.help:
            space.help = 0
        elif not space.panels.typing and space.panels.focus.leave():
            return
        elif space.panels.typing or space.panels.search_text:
            space.panels.leave_field()
        elif space.panels.home.open and not space.empty:
            space.go_home()
        elif space.session is not None and space.session.stay():
            self._show_note(say("Stopped on the way; click on the time bar to go on"))
        elif space.hand.tape is not None:
            space.hand.tape = None
        elif stopwatch.shown:
            stopwatch.hide()
        else:
            self._quit()

    def _quit(self) -> None:
        """Quit at the second press of Esc, which may have been meant for something else."""
        question = say("Esc once more quits")
        if self._space.banner.is_showing(question):
            self._space.open = False
        else:
            self._show_note(question)

    def _show_note(self, text: str) -> None:
        self._space.banner.write(text)
