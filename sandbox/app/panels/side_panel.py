"""The column on the right: the pages of the level behind tabs, and the footer below them."""

from collections.abc import Iterator, Mapping
from operator import is_not
from typing import Literal

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.elements import UIButton

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files.preferences import WindowPreferences
from sandbox.app.frame_budget import Load
from sandbox.app.pages import register
from sandbox.app.pages.page import AskingPage, CommandPage, Desk, ZoomablePage
from sandbox.app.pages.worker_registry import Workers
from sandbox.app.panels.tabs import GAP, TOP, Tabs
from sandbox.app.panels.verdicts_and_energies import FIRST, FOLDED, VerdictsAndEnergies, View
from sandbox.app.runs.session import Session
from sandbox.app.widgets.parameter_sliders import ParameterSliders
from sandbox.app.widgets.scrolling_area import MARGIN, Panel, Sheet
from sandbox.app.widgets.widget_states_and_scrolling import scroll_position, scroll_to
from sandbox.app.words.formatting import seconds
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError

REFRESH = 0.1  # s
LEAST = 160  # px, the least height of a page above the footer
AMPLE = 270  # px, the same above the default view of the footer
BEGINS = tuple("0123456789.-+")
"""The characters with which a number begins."""


class SidePanel:
    """The column of a session: a page, which scrolls if necessary, and mostly the footer below."""

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, *,
        page: str, view: View | None, workers: Workers, load: Load, comfort: WindowPreferences,
        shown: Mapping[str, bool],
    ) -> None:  # fmt: skip
        self._session, self._pen = session, pen
        self._workers = workers
        self.desk = Desk(session, workers.of, load, comfort, shown)
        """The objects with which pages work."""
        px = pen.px
        across = pygame.Rect(rect.x + px(MARGIN), px(TOP), rect.width - 2 * px(MARGIN), 0)
        self._tabs = Tabs(manager, pen, across, register.PAGES, page)
        top = self._tabs.bottom + px(TOP) - px(GAP)
        least = {FIRST: top + px(AMPLE)} if view is None else {}
        feet = (
            _possible_footers(manager, pen, rect, session, view or FIRST)
            if register.page(page).energy
            else ()
        )
        lowest = top + px(LEAST)
        self.foot = next((foot for foot in feet if foot.top >= least.get(foot.view, lowest)), None)
        """The footer below the page; None below a page that needs the room."""
        end = self.foot.top if self.foot is not None else rect.bottom
        upper = pygame.Rect(rect.x, top, rect.width, max(end - top, 1))
        self._sheet = Sheet(manager, pen, upper)
        self.page: Panel = register.page(page).open(self._sheet, self.desk)
        """The page of the chosen tab."""
        self._recalls = register.page(page).shows_recorded_states
        self.books = register.page(page).books or bool(self.foot and self.foot.books)
        """Whether the column shows where energy or momentum comes from and goes."""
        self._since, self._below = 0.0, False  # whether the footer is to be updated
        self._shown = self._state

    def scroll_pages(self, pages: float) -> None:
        """Scroll by a multiple of the visible height."""
        container = self._sheet.container
        scroll_to(container, scroll_position(container) + pages * container.rect.height)

    def show_checks(self) -> None:
        """Scroll to the checks, if the page has them."""
        if self._sheet.checks is not None:
            scroll_to(self._sheet.container, self._sheet.checks.relative_rect.y)

    def revert(self) -> None:
        """Reset all fields to the present values."""
        (self._sheet.typed or self.parameters).revert()

    def process(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        at_foot = self.foot.pressed(event.ui_element) if self.foot is not None else None
        on_page = (
            self.page.command_of(event.ui_element) if isinstance(self.page, CommandPage) else None
        )
        return at_foot or on_page or self._tabs.pressed(event.ui_element)

    def act(self, event: pygame.event.Event) -> str | None:
        """Let the page handle a click, and return its message, if there is one."""
        try:
            message = self.page.process(event)
        except SandboxError as error:
            message = say(error.message)
        if message is not None:
            self.page.update()
        return message

    def zoom_page(self, event: pygame.event.Event) -> bool:
        """Let the wheel or the key Home zoom the page, and return whether it did."""
        if not isinstance(self.page, ZoomablePage):
            return False
        if event.type == pygame.MOUSEWHEEL:
            return self.page.wheel(event.precise_y, pygame.mouse.get_pos())
        return event.type == pygame.KEYDOWN and event.key == pygame.K_HOME and self.page.home()

    def focus_answer_field(self, event: pygame.event.Event) -> bool:
        """Focus the field that awaits a number if a key begins one, and return whether it did."""
        field = self.page.awaited if isinstance(self.page, AskingPage) else None
        if field is None or event.mod & pygame.KMOD_CTRL or event.unicode not in BEGINS:
            return False
        self._sheet.manager.set_focus_set(field.get_focus_set())
        return True

    def draw_over(self, surface: pygame.Surface) -> None:
        """Write the time of the page over it while the stage shows a recorded state."""
        rect, pen = self._sheet.container.rect, self._pen
        if self._session.recalled is None or (self._recalls and self.foot is None):
            return
        at = say("This page still shows t = {t}", t=seconds(self._session.t))
        text = pen.write(pen.shorten(at, rect.width - 2 * pen.px(MARGIN), 13), 13, theme.NOTICE)
        strip = pygame.Rect(rect.x, 0, rect.width, text.height + pen.px(8))
        if self.foot is not None:  # at the bottom, so that it hides no heading
            strip.top = self.foot.top
        else:
            strip.bottom = rect.bottom
        surface.fill(theme.RAISED, strip)
        surface.blit(text, text.get_rect(center=strip.center))

    def tab(self, page: str) -> UIButton:
        """Return the tab of a page, given by its command."""
        return self._tabs.tab(page)

    @property
    def parameters(self) -> ParameterSliders:
        """The parameters; none if the page does not show them."""
        return self._sheet.parameters

    @property
    def _state(self) -> tuple[object, ...]:
        """The objects on which the display depends."""
        session = self._session
        news = self._workers.news
        looked_at = session.looking.body(session.level)
        shown = self.desk.shown.values()
        return session.world.snapshot, session.playing, session.companions, looked_at, *shown, *news

    def due_part(self, seconds: float) -> Literal["", "page", "foot"]:
        """Return the part that is updated after some time [s], while time runs."""
        if self._below:
            return "foot"
        return "page" if self._since + seconds >= REFRESH else ""

    def update(self, seconds: float) -> None:
        """Update the numbers, a few times a second while time runs.

        The footer is then updated one frame after the page, to spread the work.
        """
        self._since += seconds
        if self._below:
            self._update_foot()
        state = self._state
        old = self._shown  # shorter, if the workers have been made since
        changed = len(state) != len(old) or any(map(is_not, state, old))
        moving = self._session.playing or self._session.sought is not None
        if not changed or (moving and self._since < REFRESH):
            return
        self._since, self._shown = 0.0, state
        self.page.update()
        if self._session.playing:
            self._below = True
        else:
            self._update_foot()

    def _update_foot(self) -> None:
        self._below = False
        if self.foot is not None:
            self.foot.update()


def _possible_footers(
    manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, view: View
) -> Iterator[VerdictsAndEnergies]:
    """Yield possible footers: the wanted view, then the lowest; each is removed for the next."""
    for each in dict.fromkeys((view, FOLDED)):
        foot = VerdictsAndEnergies(manager, pen, rect, session, each)
        yield foot
        foot.kill()
