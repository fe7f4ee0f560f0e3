"""The column on the right: what the level is, its parameters, its checks, its energy."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.elements import UIButton, UIImage, UIScrollingContainer

from sandbox.app import cards, graph
from sandbox.app.keys import Command
from sandbox.app.panels.parameters import Parameters
from sandbox.app.panels.widgets import scroll, scrolled
from sandbox.app.session import Session
from sandbox.app.text import Pen

MARGIN = 16  # px
BAR = 26  # px, kept free for the scroll bar
REFRESH = 0.1  # s
GRAPH = 66, 120  # px, how high the graph may be
SWITCH = 58, 22  # px, the button that changes graph and bars
CAPTION = 82  # px, what stands above and below the graph
FOOT = 8  # px, left free below all


class SidePanel:
    """The column of a session: what scrolls if it must, and below it the energy, always seen."""

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, *,
        as_graph: bool,
    ) -> None:  # fmt: skip
        self._manager, self._pen, self._session = manager, pen, session
        self._graph = as_graph
        self._width = rect.width - MARGIN - BAR
        self._graph_size = self._width, min(max(rect.height // 5 - CAPTION, GRAPH[0]), GRAPH[1])
        energy = self._draw_energy()
        upper = pygame.Rect(rect.topleft, (rect.width, max(rect.height - energy.height - FOOT, 1)))
        self._energy = UIImage(
            energy.get_rect(topleft=(rect.x + MARGIN, upper.bottom)), energy, manager
        )
        self._switch = UIButton(
            pygame.Rect((rect.x + MARGIN + self._width - SWITCH[0], upper.bottom + 4), SWITCH),
            "Bars" if as_graph else "Graph", manager,
            tool_tip_text="energy as a graph or as bars (E)",
        )  # fmt: skip
        self._container = UIScrollingContainer(upper, manager, allow_scroll_x=False)
        y = MARGIN
        y = self._below(self._image(cards.header(pen, self._width, session.level), y)) + 8
        if session.level.parameters:
            y = self._below(self._image(cards.heading(pen, self._width, "Parameters"), y))
        area = pygame.Rect(MARGIN, y, self._width, 0)
        self.parameters = Parameters(
            manager, pen, self._container, area, session.level, session.values
        )
        self._top = y + self.parameters.height + 8
        self._checks = self._image(self._draw_checks(), self._top)
        self._since = 0.0
        self._snapshot = session.world.snapshot
        self._playing = session.playing
        self._arrange()

    def _image(self, surface: pygame.Surface, y: int) -> UIImage:
        rect = pygame.Rect((MARGIN, y), surface.size)
        return UIImage(rect, surface, self._manager, container=self._container)

    @staticmethod
    def _below(image: UIImage) -> int:
        return int(image.relative_rect.bottom)

    def turn(self, pages: float) -> None:
        """Scroll by a part of what is seen at once."""
        by = pages * self._container.rect.height
        scroll(self._container, scrolled(self._container) + by)

    def focus(self, direction: int) -> None:
        """Go on to the next number field, or back, and bring it into view."""
        field = self.parameters.focus(direction)
        if field is not None:
            scroll(self._container, field.relative_rect.y - self._container.rect.height / 2)

    def process(self, event: pygame.event.Event) -> Command | None:
        """Return the command whose button was pressed, if one was."""
        pressed = event.type == UI_BUTTON_PRESSED and event.ui_element is self._switch
        return "energy" if pressed else None

    @property
    def switch(self) -> UIButton:
        """The button that changes graph and bars."""
        return self._switch

    def update(self, seconds: float) -> None:
        """Bring the numbers up to date, a few times a second while time runs."""
        session = self._session
        self._since += seconds
        snapshot, playing = session.world.snapshot, session.playing
        changed = snapshot is not self._snapshot or playing != self._playing
        if not changed or (playing and self._since < REFRESH):
            return
        self._since, self._snapshot, self._playing = 0.0, snapshot, playing
        self._replace(self._checks, self._draw_checks())
        self._replace(self._energy, self._draw_energy())
        self._arrange()
        self.parameters.show(session.values)

    def _replace(self, image: UIImage, surface: pygame.Surface) -> None:
        if image.relative_rect.size != surface.size:
            image.set_dimensions(surface.size)
        image.set_image(surface)

    def _arrange(self) -> None:
        """Let all be scrolled to, wherever the checks end."""
        height = self._below(self._checks) + 2
        width = self._width + MARGIN
        if self._container.scrollable_container.rect.height != height:
            self._container.set_scrollable_area_dimensions((width, height))

    def _draw_checks(self) -> pygame.Surface:
        session = self._session
        return cards.checks(
            self._pen, self._width, session.readings(), disturbed=session.world.disturbed
        )

    def _draw_energy(self) -> pygame.Surface:
        session = self._session
        if not self._graph:
            return cards.ledger(self._pen, self._width, session.balance)
        drawn = graph.energies(self._graph_size, session.history, session.duration)
        now = session.energies()
        return cards.energy(self._pen, self._width, session.start_energies, now, drawn)
