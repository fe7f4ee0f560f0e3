"""All panels around the stage, built for a window of a given size."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.core import UIContainer
from pygame_gui.core.utility import set_default_manager

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files.level_entries import Entry
from sandbox.app.files.preferences import Comfort
from sandbox.app.frame_time import Load
from sandbox.app.home.home import Home
from sandbox.app.pages import register
from sandbox.app.pages.workers import Workers
from sandbox.app.panels import messages
from sandbox.app.panels.controls import Controls
from sandbox.app.panels.focus import Focus
from sandbox.app.panels.home_bar import HomeBar
from sandbox.app.panels.layout import Layout, divide
from sandbox.app.panels.levels import LevelList
from sandbox.app.panels.refusal import Refusal
from sandbox.app.panels.side_panel import SidePanel
from sandbox.app.runs.session import Session
from sandbox.app.widgets.file_dialog import OpenDialog
from sandbox.app.widgets.manager import Manager
from sandbox.app.widgets.text_field import Field
from sandbox.app.words import language
from sandbox.model.errors import SandboxError

if TYPE_CHECKING:
    from pygame_gui.elements import UIButton

    from sandbox.app.panels.bar import Bar
    from sandbox.app.panels.footer import View


class Panels:
    """The widgets of the window, which are rebuilt when its size or its level changes.

    Attributes
    ----------
    manager
        pygame_gui's.
    layout
        How the window is divided.
    list, side
        The two columns; None while they are hidden.
    controls
        The bar below: that of the run, or of the cards while they are shown.
    energy
        How the energy is shown; None as long as nobody has chosen.
    page
        The command of the side panel's tab that is chosen.
    refusal
        The page that says why the level cannot be opened; None if it can.
    home
        The cards of the levels, in place of the stage while they are shown.
    focus
        Where the keyboard is among the widgets.
    offer
        The button that runs a level that had to stop at another rate; None if there is none.
    """

    def __init__(
        self, pen: Pen, size: tuple[int, int], workers: Workers, load: Load, comfort: Comfort
    ) -> None:
        self._pen, self._workers, self._load, self._comfort = pen, workers, load, comfort
        self._hidden: set[str] = set()
        self.energy: View | None = None
        self._advised: float | None = None
        self.side: SidePanel | None = None
        self._listed: object = None  # what the list was built for
        self._sought = ""
        self.list: LevelList | None = None
        self.page = register.PAGES[0].command
        self.home = Home(pen)
        self.focus = Focus()
        self.renew(size)

    def renew(self, size: tuple[int, int]) -> None:
        """Make all in the present theme, scale and language, from the next building on."""
        self._dialog: OpenDialog | None = None
        self._sought = self.sought
        self.list = None
        self.offer: UIButton | None = None
        self.manager = Manager(
            size, theme.widgets(self._pen.scale), enable_live_theme_updates=False,
            starting_language=language.used(),
        )  # fmt: skip
        set_default_manager(self.manager)  # the first would stay for good, with all its widgets
        self.home.renew()

    def hide_or_show(self, column: str) -> None:
        """Hide a column, `levels` or `side`, or show it again, from the next building on."""
        self._hidden ^= {column}

    def show(self, page: str) -> None:
        """Show a page of the side column, from the next building on."""
        self.page = page
        self._hidden -= {"side"}

    def build(
        self, size: tuple[int, int], entries: Sequence[Entry], path: Path | None,
        session: Session | None, refused: SandboxError | None,
    ) -> None:  # fmt: skip
        """Build everything, for the level of a session or for why there is none."""
        manager, pen = self.manager, self._pen
        manager.set_window_resolution(size)
        shown = session is not None and not self.home.open
        with_side = shown and "side" not in self._hidden
        layout = divide(size, levels="levels" not in self._hidden, side=with_side, scale=pen.scale)
        self.layout: Layout = layout
        self._entries = entries
        self._clear((size, layout.levels.width, tuple(entries)))
        if self.list is None and layout.levels.width:
            self.list = LevelList(manager, pen, layout.levels, entries, self._sought)
            if self.focus.lost:  # maybe by a row out of sight, which is to have it again
                self.list.complete()
        if self.list is not None:
            self.list.choose(path)
        self.side = None
        if session is not None and with_side and layout.side.width:
            self.side = SidePanel(
                manager,
                pen,
                layout.side,
                session,
                page=self.page,
                view=self.energy,
                workers=self._workers,
                load=self._load,
                comfort=self._comfort,
            )
        if self.home.open:
            self.controls: Bar = HomeBar(manager, pen, layout.controls, session)
        else:
            self.controls = Controls(manager, pen, layout.controls)
        self.refusal = None
        if refused is not None and not self.home.open:
            self.refusal = Refusal(manager, pen, layout.stage, refused)
        self.offer = None

    def _clear(self, listed: object) -> None:
        """Remove all but a list that is built for the same: making it takes a tenth of a second."""
        self.close_dialog()
        self.manager.set_focus_set(None)
        if self.list is not None and listed != self._listed:
            self._sought, self.list = self.list.sought, None
        self._listed = listed
        kept = self.list.column if self.list is not None else None
        root = self.manager.get_root_container()
        assert isinstance(root, UIContainer)
        for element in list(root.elements):
            if element is not kept:
                element.kill()  # type: ignore[no-untyped-call]

    def update(self, seconds: float) -> None:
        """Update all widgets after some time [s]."""
        self.manager.update(seconds)
        if self.list is not None:
            self.list.update(self.focus.element(self.manager, self.layout))

    def mark_stars(self) -> None:
        """Let the list show the stars that have been earned by now."""
        if self.list is not None:
            self.list.mark_stars()

    def turn(self, pages: float) -> None:
        """Scroll whatever can be scrolled by a part of its height."""
        turned = self.side or self.refusal
        if turned is not None:
            turned.turn(pages)

    def go_on(self, direction: int) -> None:
        """Give the keyboard to the next widget, or to the one before: to rows out of sight, too."""
        if self.list is not None:
            self.list.reach(self.focus.element(self.manager, self.layout))
        self.focus.go(self.manager, self.layout, direction)

    def seek(self) -> None:
        """Let a person type what level to look for."""
        if self.list is not None:
            self.manager.set_focus_set(self.list.field.get_focus_set())
            self.list.field.select_range = [0, len(self.list.sought)]

    def list_all(self) -> None:
        """Look for no level any more."""
        if self.list is not None:
            self.list.clear()

    def let_go(self) -> None:
        """Leave the field that is typed in as it was; if none is, look for no level any more."""
        if self.dialog is not None:
            self.close_dialog()
            return
        if self.list is not None and (self._seeking or not self.typing):
            self.list.clear()
        if self.side is not None:
            self.side.revert()
        self.manager.set_focus_set(None)

    def ask_for_file(self, folder: Path) -> None:
        """Let a person choose a file, at first in a folder."""
        self.close_dialog()
        self.manager.set_focus_set(None)
        self._dialog = OpenDialog(self.manager, self.layout.stage, folder)

    def close_dialog(self) -> None:
        """Ask for no file any more."""
        if self.dialog is not None:
            self.dialog.kill()  # type: ignore[no-untyped-call]

    @property
    def dialog(self) -> OpenDialog | None:
        """Where a file is chosen; None while none is."""
        shown = self._dialog is not None and self._dialog.alive()  # type: ignore[no-untyped-call]
        return self._dialog if shown else None

    def wanted(self, event: pygame.event.Event) -> Path | None:
        """Return the level that was chosen in the list or in the dialog, if one was."""
        path = self._dialog.picked(event) if self._dialog is not None else None
        if path is None and self.list is not None:
            path = self.list.process(event)
        return path

    def pressed(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        way = self.list.pressed(event) if self.list is not None else None
        return way or self.controls.process(event)

    def follow_home(self) -> None:
        """Let the home page show what is looked for in the list."""
        found = self.list.found if self.list is not None else self._entries
        self.home.update(self.layout.stage, found, self.sought)

    def advise(self, rate: float | None) -> None:
        """Offer to run again at a rate [Hz], or offer nothing."""
        if self.home.open:
            rate = None
        if self.offer is not None and (rate is None or self._advised != rate):
            self.offer.kill()  # type: ignore[no-untyped-call]
            self.offer = None
        if self.offer is None and rate is not None:
            self.offer = messages.offer(self.manager, self._pen, self.layout.stage, rate)
        self._advised = rate

    def accepts(self, event: pygame.event.Event) -> bool:
        """Whether an event takes the offer."""
        pressed = event.type == UI_BUTTON_PRESSED
        return pressed and self.offer is not None and event.ui_element is self.offer

    @property
    def typing(self) -> bool:
        """Whether something is being typed into a field, or a file chosen."""
        focused = self.manager.focused_set or ()
        return self.dialog is not None or any(isinstance(each, Field) for each in focused)

    @property
    def _seeking(self) -> bool:
        """Whether it is being typed what level to look for."""
        return self.list is not None and self.list.field.is_focused

    @property
    def sought(self) -> str:
        """What is looked for in the list that is shown."""
        return self.list.sought if self.list is not None else ""
