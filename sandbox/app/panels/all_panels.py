"""All panels around the stage, built for a window of a given size."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.core import UIContainer
from pygame_gui.core.utility import set_default_manager

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files.level_list_entries import Entry
from sandbox.app.files.preferences import WindowPreferences
from sandbox.app.frame_budget import Load
from sandbox.app.home.level_gallery import LevelGallery
from sandbox.app.pages import register
from sandbox.app.pages.worker_registry import Workers
from sandbox.app.panels import stage_messages
from sandbox.app.panels.home_bar import HomeBar
from sandbox.app.panels.keyboard_focus import KeyboardFocus
from sandbox.app.panels.level_list import LevelList
from sandbox.app.panels.play_bar import PlayBar
from sandbox.app.panels.refused_level import RefusedLevel
from sandbox.app.panels.side_panel import SidePanel
from sandbox.app.panels.window_layout import WindowLayout, divide
from sandbox.app.runs.session import Session
from sandbox.app.widgets.file_dialog import FileDialog
from sandbox.app.widgets.text_field import TextField
from sandbox.app.widgets.ui_manager import Manager
from sandbox.app.words import language
from sandbox.model.errors import SandboxError

if TYPE_CHECKING:
    from pygame_gui.elements import UIButton

    from sandbox.app.panels.button_bar import Bar
    from sandbox.app.panels.verdicts_and_energies import View


class Panels:
    """The widgets of the window, which are rebuilt when its size or its level changes.

    Attributes
    ----------
    manager
        The manager of pygame_gui.
    layout
        The division of the window.
    list, side
        The two columns; None while they are hidden.
    controls
        The bar at the bottom: that of the run, or that of the home page while it is shown.
    energy
        The view of the energy; None until it is chosen.
    page
        The command of the chosen tab of the side panel.
    refusal
        The page with the reason why the level cannot be opened; None if it can.
    home
        The home page with the cards of the levels, in place of the stage while it is shown.
    focus
        The keyboard focus.
    offer
        The button that runs a failed level again at another rate; None if there is none.
    """

    def __init__(
        self, pen: Pen, size: tuple[int, int], workers: Workers, load: Load,
        comfort: WindowPreferences, shown: Mapping[str, bool],
    ) -> None:  # fmt: skip
        self._pen, self._workers, self._load, self._comfort = pen, workers, load, comfort
        self._shown = shown  # whether each overlay is drawn, by name
        self._hidden: set[str] = set()
        self.energy: View | None = None
        self._advised: float | None = None
        self.side: SidePanel | None = None
        self._listed: object = None  # the key for which the list was built
        self._sought = ""
        self.list: LevelList | None = None
        self.page = register.PAGES[0].command
        self.home = LevelGallery(pen)
        self.focus = KeyboardFocus()
        self._begin(size)

    def renew(self, size: tuple[int, int]) -> None:
        """Use the present theme, scale and language, from the next `build` on."""
        # Else the focus would stay with an invisible widget, and keep all of them in memory.
        self._root().kill()  # type: ignore[no-untyped-call]
        self._begin(size)

    def _begin(self, size: tuple[int, int]) -> None:
        self._dialog: FileDialog | None = None
        self._sought = self.search_text
        self.list = None
        self.offer: UIButton | None = None
        self.manager = Manager(
            size, theme.widgets(self._pen.scale), enable_live_theme_updates=False,
            starting_language=language.used(),
        )  # fmt: skip
        set_default_manager(self.manager)  # else the first stays in memory, with its widgets
        self.home.renew()

    def hide_or_show(self, column: str) -> None:
        """Hide a column, `levels` or `side`, or show it again, from the next `build` on."""
        self._hidden ^= {column}

    def show(self, page: str) -> None:
        """Show a page of the side column, from the next `build` on."""
        self.page = page
        self._hidden -= {"side"}

    def build(
        self, size: tuple[int, int], entries: Sequence[Entry], path: Path | None,
        session: Session | None, refused: SandboxError | None,
    ) -> None:  # fmt: skip
        """Build all widgets, for the level of a session, or for the error if there is none."""
        manager, pen = self.manager, self._pen
        manager.set_window_resolution(size)
        shown = session is not None and not self.home.open
        with_side = shown and "side" not in self._hidden
        layout = divide(size, levels="levels" not in self._hidden, side=with_side, scale=pen.scale)
        self.layout: WindowLayout = layout
        self._entries = entries
        self._clear((size, layout.levels.width, tuple(entries)))
        if self.list is None and layout.levels.width:
            self.list = LevelList(manager, pen, layout.levels, entries, self._sought)
            if self.focus.lost:  # perhaps the focus of a hidden row, which gets it again
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
                shown=self._shown,
            )
        if self.home.open:
            self.controls: Bar = HomeBar(manager, pen, layout.controls, session)
        else:
            self.controls = PlayBar(manager, pen, layout.controls, home=self.list is None)
        self.refusal = None
        if refused is not None and not self.home.open:
            self.refusal = RefusedLevel(manager, pen, layout.stage, refused)
        self.offer = None

    def _clear(self, listed: object) -> None:
        """Remove all widgets but a list with the same key, which takes a tenth of a second."""
        self.close_dialog()
        self.manager.set_focus_set(None)
        if self.list is not None and listed != self._listed:
            self._sought, self.list = self.list.search_text, None
        self._listed = listed
        kept = self.list.column if self.list is not None else None
        for element in list(self._root().elements):
            if element is not kept:
                element.kill()  # type: ignore[no-untyped-call]

    def _root(self) -> UIContainer:
        root = self.manager.get_root_container()
        assert isinstance(root, UIContainer)
        return root

    def update(self, seconds: float) -> None:
        """Update all widgets after some time [s]."""
        self.manager.update(seconds)
        if self.list is not None:
            self.list.update(self.focus.element(self.manager, self.layout))

    def mark_stars(self) -> None:
        """Show the stars earned so far in the list."""
        if self.list is not None:
            self.list.mark_stars()

    def scroll_pages(self, pages: float) -> None:
        """Scroll the side panel or the refusal by a multiple of its height."""
        panel = self.side or self.refusal
        if panel is not None:
            panel.scroll_pages(pages)

    def move_focus(self, direction: int) -> None:
        """Move the focus to the next or the previous widget, including rows out of sight."""
        if self.list is not None:
            self.list.make_reachable_rows(self.focus.element(self.manager, self.layout))
        self.focus.move(self.manager, self.layout, direction)

    def seek(self) -> None:
        """Focus the search field."""
        if self.list is not None:
            self.manager.set_focus_set(self.list.field.get_focus_set())
            self.list.field.select_range = [0, len(self.list.search_text)]

    def list_all(self) -> None:
        """Clear the search."""
        if self.list is not None:
            self.list.clear()

    def leave_field(self) -> None:
        """Close the dialog, or revert and leave the field with the focus, or clear the search."""
        if self.dialog is not None:
            self.close_dialog()
            return
        if self.list is not None and (self._seeking or not self.typing):
            self.list.clear()
        if self.side is not None:
            self.side.revert()
        self.manager.set_focus_set(None)

    def ask_for_file(self, folder: Path) -> None:
        """Open the file dialog in a folder."""
        self.close_dialog()
        self.manager.set_focus_set(None)
        self._dialog = FileDialog(self.manager, self.layout.stage, folder)

    def close_dialog(self) -> None:
        """Close the file dialog."""
        if self.dialog is not None:
            self.dialog.kill()  # type: ignore[no-untyped-call]

    @property
    def dialog(self) -> FileDialog | None:
        """The file dialog; None while it is closed."""
        shown = self._dialog is not None and self._dialog.alive()  # type: ignore[no-untyped-call]
        return self._dialog if shown else None

    def chosen_level(self, event: pygame.event.Event) -> Path | None:
        """Return the level that was chosen in the list or in the dialog; None if none was."""
        path = self._dialog.picked(event) if self._dialog is not None else None
        if path is None and self.list is not None:
            path = self.list.process(event)
        return path

    def pressed(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        command = self.list.pressed(event) if self.list is not None else None
        return command or self.controls.process(event)

    def follow_home(self) -> None:
        """Show the search result of the list on the home page."""
        found = self.list.matching_levels if self.list is not None else self._entries
        self.home.update(self.layout.stage, found, self.search_text)

    def offer_rate(self, rate: float | None) -> None:
        """Offer to run again at a rate [Hz]; None offers nothing."""
        if self.home.open:
            rate = None
        if self.offer is not None and (rate is None or self._advised != rate):
            self.offer.kill()  # type: ignore[no-untyped-call]
            self.offer = None
        if self.offer is None and rate is not None:
            self.offer = stage_messages.offer(self.manager, self._pen, self.layout.stage, rate)
        self._advised = rate

    def accepts_offer(self, event: pygame.event.Event) -> bool:
        """Return whether an event accepts the offer."""
        pressed = event.type == UI_BUTTON_PRESSED
        return pressed and self.offer is not None and event.ui_element is self.offer

    @property
    def typing(self) -> bool:
        """Whether a field has the focus, or the file dialog is open."""
        focused = self.manager.focused_set or ()
        return self.dialog is not None or any(isinstance(each, TextField) for each in focused)

    @property
    def _seeking(self) -> bool:
        """Whether the search field has the focus."""
        return self.list is not None and self.list.field.is_focused

    @property
    def search_text(self) -> str:
        """The text of the search field; empty if the list is hidden."""
        return self.list.search_text if self.list is not None else ""
