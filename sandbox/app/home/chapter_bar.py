"""The bar above the cards, with a button for each chapter."""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.home.card_grid import Heading

CAPTION = 14  # font size
HEIGHT = 30  # px, of a button
MARGIN = 24  # px, left and right of the bar
GAP = 6  # px, between two buttons, and above and below a row
PADDING = 11  # px, beside a caption


class ChapterBar:
    """The headings of the cards as buttons, in as many rows as they need."""

    def __init__(self, pen: Pen) -> None:
        self._pen = pen
        self._area = pygame.Rect(0, 0, 0, 0)
        self._places: Sequence[tuple[Heading, pygame.Rect]] = ()
        self.hovered: Heading | None = None
        """The heading under the mouse, or None."""

    def take_room(self, area: pygame.Rect, headings: Sequence[Heading]) -> pygame.Rect:
        """Take the top of an area, and return the rest; a single heading needs no bar."""
        self._places = list(self._placed(area, headings)) if len(headings) > 1 else ()
        self.hovered = self.hovered if self.hovered in headings else None
        bottom = self._places[-1][1].bottom + self._pen.px(GAP) if self._places else area.y
        height = min(bottom - area.y, area.height)
        self._area = pygame.Rect(area.topleft, (area.width, height))
        return pygame.Rect(area.x, area.y + height, area.width, area.height - height)

    def _placed(
        self, area: pygame.Rect, headings: Sequence[Heading]
    ) -> Iterator[tuple[Heading, pygame.Rect]]:
        px = self._pen.px
        x, y = left, _ = area.x + px(MARGIN), area.y + px(GAP)
        for heading in headings:
            width = self._pen.write(heading.text, CAPTION).width + 2 * px(PADDING)
            if x > left and x + width > area.right - px(MARGIN):
                x, y = left, y + px(HEIGHT + GAP)
            yield heading, pygame.Rect(x, y, width, px(HEIGHT))
            x += width + px(GAP)

    def rect_of(self, text: str) -> pygame.Rect:
        """Return the rectangle of a chapter's button in the window [px]."""
        return next(place for heading, place in self._places if heading.text == text)

    def follow(self, pixel: tuple[int, int]) -> bool:
        """Update the hovered heading, and return whether the mouse is over the bar."""
        over = (heading for heading, place in self._places if place.collidepoint(pixel))
        self.hovered = next(over, None)
        return self._area.collidepoint(pixel)

    def draw(self, surface: pygame.Surface, top: float) -> None:
        """Draw the chapters, and mark the one whose cards are at the visible `top` [px]."""
        surface.fill(theme.STAGE, self._area.clip(surface.get_rect()))
        chapter = _at(top, [heading for heading, _ in self._places])
        for heading, place in self._places:
            lit = heading is chapter or heading is self.hovered
            pygame.draw.rect(surface, theme.RAISED if lit else theme.PANEL, place, border_radius=6)
            rim = theme.ACCENT if heading is chapter else theme.EDGE
            pygame.draw.rect(surface, rim, place, 1, border_radius=6)
            image = self._pen.write(heading.text, CAPTION, theme.TEXT if lit else theme.DIM)
            surface.blit(image, image.get_rect(center=place.center))


def _at(top: float, headings: Sequence[Heading]) -> Heading | None:
    """Return the heading of the cards at a height on their sheet [px]."""
    ends = [(first, second.y) for first, second in pairwise(headings)]
    return next((each for each, end in ends if top < end), headings[-1] if headings else None)
