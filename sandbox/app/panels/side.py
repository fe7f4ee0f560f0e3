"""The column on the right: the pages of the level behind tabs, and the foot below them."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.elements import UIButton

from sandbox.app.load import Load
from sandbox.app.pages import register
from sandbox.app.pages.page import Desk
from sandbox.app.pages.workers import Workers
from sandbox.app.panels.foot import Foot, View
from sandbox.app.panels.tabs import GAP, TOP, Tabs
from sandbox.app.session import Session
from sandbox.app.text import Pen
from sandbox.app.widgets.gui import scroll, scrolled
from sandbox.app.widgets.parameters import Parameters
from sandbox.app.widgets.sheet import MARGIN, Panel, Sheet

REFRESH = 0.1  # s


class SidePanel:
    """The column of a session: a page that scrolls if it must, and below most of them its foot.

    Attributes
    ----------
    page
        What the chosen tab shows.
    desk
        What the pages work with.
    foot
        What stays below the page; None below one that needs the room.
    """

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, *,
        page: str, view: View, workers: Workers, load: Load,
    ) -> None:  # fmt: skip
        self._session = session
        self._workers = workers
        self.desk = Desk(session, workers.all, load)
        self.foot = Foot(manager, pen, rect, session, view) if register.page(page).energy else None
        end = self.foot.top if self.foot is not None else rect.bottom
        across = pygame.Rect(rect.x + MARGIN, TOP, rect.width - 2 * MARGIN, 0)
        self._tabs = Tabs(manager, pen, across, register.PAGES, page)
        top = self._tabs.bottom + TOP - GAP
        upper = pygame.Rect(rect.x, top, rect.width, max(end - top, 1))
        self._sheet = Sheet(manager, pen, upper)
        self.page: Panel = register.page(page).open(self._sheet, self.desk)
        self._since = 0.0
        self._shown = self._state

    def turn(self, pages: float) -> None:
        """Scroll by a part of what is seen at once."""
        container = self._sheet.container
        scroll(container, scrolled(container) + pages * container.rect.height)

    def show_checks(self) -> None:
        """Scroll to the checks, where the page has them."""
        if self._sheet.checks is not None:
            scroll(self._sheet.container, self._sheet.checks.relative_rect.y)

    def focus(self, direction: int) -> None:
        """Go on to the next number field, or back, and bring it into view."""
        field = (self._sheet.typed or self.parameters).focus(direction)
        if field is not None:
            container = self._sheet.container
            scroll(container, field.relative_rect.y - container.rect.height / 2)

    def revert(self) -> None:
        """Let all fields say again what is the case."""
        (self._sheet.typed or self.parameters).revert()

    def process(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        at_foot = self.foot.pressed(event.ui_element) if self.foot is not None else None
        return at_foot or self._tabs.pressed(event.ui_element)

    def act(self, event: pygame.event.Event) -> str | None:
        """Let the page do what was clicked on; return what is to be told, None if nothing was."""
        told = self.page.process(event)
        if told is not None:
            self.page.update()
        return told

    def tab(self, page: str) -> UIButton:
        """Return the tab of a page, given by its command."""
        return self._tabs.tab(page)

    @property
    def parameters(self) -> Parameters:
        """The parameters; none where the page has no room for them."""
        return self._sheet.parameters

    @property
    def _state(self) -> tuple[object, ...]:
        """What is shown depends on."""
        session = self._session
        news = self._workers.news
        looked_at = session.looking.body
        return session.world.snapshot, session.playing, session.companions, looked_at, *news

    def update(self, seconds: float) -> None:
        """Bring the numbers up to date, a few times a second while time runs."""
        self._since += seconds
        state = self._state
        changed = any(new is not old for new, old in zip(state, self._shown, strict=True))
        if not changed or (self._session.playing and self._since < REFRESH):
            return
        self._since, self._shown = 0.0, state
        self.page.update()
        if self.foot is not None:
            self.foot.update()
