"""The column on the right: the pages of the level behind tabs, and below its energy."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.elements import UIButton, UIImage

from sandbox.app import graph
from sandbox.app.cards.energy import energy, ledger
from sandbox.app.commands import tip
from sandbox.app.load import Load
from sandbox.app.pages import register
from sandbox.app.pages.page import Desk
from sandbox.app.pages.workers import Workers
from sandbox.app.panels.tabs import GAP, TOP, Tabs
from sandbox.app.preferences import Comfort
from sandbox.app.session import Session
from sandbox.app.text import Pen
from sandbox.app.widgets.gui import scroll, scrolled
from sandbox.app.widgets.parameters import Parameters
from sandbox.app.widgets.sheet import MARGIN, Panel, Sheet

REFRESH = 0.1  # s
GRAPH = 66, 120  # px, how high the graph may be
SWITCH = 58, 22  # px, the button that changes graph and bars
CAPTION = 82  # px, what stands above and below the graph
FOOT = 8  # px, left free below all


class SidePanel:
    """The column of a session: a page that scrolls if it must, and below most the energy.

    Attributes
    ----------
    page
        What the chosen tab shows.
    desk
        What the pages work with.
    """

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, *,
        page: str, as_graph: bool, workers: Workers, load: Load, comfort: Comfort,
    ) -> None:  # fmt: skip
        self._manager, self._pen, self._session = manager, pen, session
        self._graph, self._workers = as_graph, workers
        self.desk = Desk(session, workers.all, load, comfort)
        self._energy: UIImage | None = None
        self._switch: UIButton | None = None
        upper = self._put_energy(rect) if register.page(page).energy else rect
        across = pygame.Rect(rect.x + MARGIN, TOP, rect.width - 2 * MARGIN, 0)
        self._tabs = Tabs(manager, pen, across, register.PAGES, page)
        top = self._tabs.bottom + TOP - GAP
        upper = pygame.Rect(upper.x, top, upper.width, max(upper.height - top, 1))
        self._sheet = Sheet(manager, pen, upper)
        self.page: Panel = register.page(page).open(self._sheet, self.desk)
        self._since = 0.0
        self._shown = self._state

    def _put_energy(self, rect: pygame.Rect) -> pygame.Rect:
        """Put the energy at the foot, and return what is left above it."""
        self._width = rect.width - 2 * MARGIN - 10
        self._graph_size = self._width, min(max(rect.height // 5 - CAPTION, GRAPH[0]), GRAPH[1])
        drawn = self._draw_energy()
        upper = pygame.Rect(rect.topleft, (rect.width, max(rect.height - drawn.height - FOOT, 1)))
        place = drawn.get_rect(topleft=(rect.x + MARGIN, upper.bottom))
        self._energy = UIImage(place, drawn, self._manager)
        self._switch = UIButton(
            pygame.Rect((place.right - SWITCH[0], upper.bottom + 4), SWITCH),
            "Bars" if self._graph else "Graph", self._manager,
            tool_tip_text=tip("energy"),
        )  # fmt: skip
        return upper

    def turn(self, pages: float) -> None:
        """Scroll by a part of what is seen at once."""
        container = self._sheet.container
        scroll(container, scrolled(container) + pages * container.rect.height)

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
        if self._switch is not None and event.ui_element is self._switch:
            return "energy"
        return self._tabs.pressed(event.ui_element)

    def act(self, event: pygame.event.Event) -> str | None:
        """Let the page do what was clicked on; return what is to be told, None if nothing was."""
        told = self.page.process(event)
        if told is not None:
            self.page.update()
        return told

    @property
    def switch(self) -> UIButton:
        """The button that changes graph and bars, below a page that has it."""
        assert self._switch is not None
        return self._switch

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
        if self._energy is not None:
            self._sheet.replace(self._energy, self._draw_energy())

    def _draw_energy(self) -> pygame.Surface:
        session = self._session
        if not self._graph:
            ahead = not session.world.kicks.composed
            return ledger(self._pen, self._width, session.books.balance, ahead=ahead)
        drawn = graph.energies(self._graph_size, session.books.history, session.duration)
        now = session.books.energies
        return energy(self._pen, self._width, session.books.start, now, drawn)
