"""The column on the right: what the level is, its parameters, its checks, its energy."""

import pygame
from pygame_gui import UIManager
from pygame_gui.elements import UIImage, UIScrollingContainer

from sandbox.app import cards
from sandbox.app.panels.parameters import Parameters
from sandbox.app.panels.widgets import scroll, scrolled
from sandbox.app.session import Session
from sandbox.app.text import Pen

MARGIN = 16  # px
BAR = 26  # px, kept free for the scroll bar
REFRESH = 0.1  # s


class SidePanel:
    """The column of a session. It scrolls as one where the window is too low for it."""

    def __init__(self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session) -> None:
        self._manager, self._pen, self._session = manager, pen, session
        self._width = rect.width - MARGIN - BAR
        self._container = UIScrollingContainer(rect, manager, allow_scroll_x=False)
        y = MARGIN
        y = self._below(self._image(cards.header(pen, self._width, session.level), y)) + 14
        if session.level.parameters:
            y = self._below(self._image(cards.heading(pen, self._width, "Parameters"), y))
        area = pygame.Rect(MARGIN, y, self._width, 0)
        self.parameters = Parameters(
            manager, pen, self._container, area, session.level, session.values
        )
        self._top = y + self.parameters.height + 8
        self._checks = self._image(self._draw_checks(), self._top)
        self._energy = self._image(self._draw_energy(), self._below(self._checks))
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
        """Put the energy below the checks, wherever they end."""
        below = self._below(self._checks)
        if self._energy.relative_rect.y != below:
            self._energy.set_relative_position((MARGIN, below))
        height = self._below(self._energy) + MARGIN
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
        return cards.energy(self._pen, self._width, session.start_energies, session.energies())
