"""A card: a column of text and pictures, drawn the same way on every page."""

from collections.abc import Sequence

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color

GAP = 3  # px
INDENT = 24  # px
SMALLEST = 10
"""The smallest legible size of letters."""
COLUMNS = (0.39, 0.39, 0.22)
"""The widths of the columns: measured, expected and error."""


class TextColumn:
    """A column to which text and pictures are added from top to bottom."""

    def __init__(self, pen: Pen, width: int) -> None:
        self.pen = pen
        self.width = width
        self.y = 0
        self.indent = pen.px(INDENT)
        self._parts: list[tuple[pygame.Surface, tuple[int, int]]] = []

    def text(
        self, text: str, size: int = 14, color: Color | None = None, bold: bool = False,
        indent: int = 0,
    ) -> None:  # fmt: skip
        """Add a wrapped paragraph."""
        for line in self.pen.paragraph(text, self.width - indent, size, color, bold):
            self.put(line, indent)
            self.y += line.height

    def put(self, part: pygame.Surface, x: int, y: int = 0) -> None:
        """Add a picture at the current height, without moving down."""
        self._parts.append((part, (x, self.y + y)))

    def heading(self, text: str) -> None:
        """Add a heading under a line."""
        line = pygame.Surface((self.width, 1))
        line.fill(theme.EDGE)
        self.put(line, 0)
        self.y += self.pen.px(8)
        self.text(text, 14, theme.ACCENT, bold=True)
        self.y += 4

    def columns(self, cells: Sequence[tuple[str, Color]], size: int) -> None:
        """Add a row of measured value, expected value and error, in smaller letters if needed."""
        x = float(self.indent)
        for (text, color), share in zip(cells, COLUMNS, strict=True):
            room = share * (self.width - self.indent)
            images = (self.pen.write(text, s, color) for s in range(size, SMALLEST, -1))
            fitting = (image for image in images if image.width + self.pen.px(2 * GAP) <= room)
            self.put(next(fitting, self.pen.write(text, SMALLEST, color)), round(x))
            x += room
        self.y += self.pen.height(size)

    def drawn(self, background: Color | None = None) -> pygame.Surface:
        """Return the card as drawn so far."""
        surface = pygame.Surface((self.width, max(self.y, 1)))
        surface.fill(background or theme.PANEL)
        surface.blits(self._parts)
        return surface


def heading(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw a heading under a line."""
    card = TextColumn(pen, width)
    card.heading(text)
    return card.drawn()


def titled_note(pen: Pen, width: int, title: str, text: str, size: int = 13) -> pygame.Surface:
    """Draw a heading with a few words below it."""
    card = TextColumn(pen, width)
    card.heading(title)
    card.text(text, size, theme.DIM)
    return card.drawn()


def label(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw a few words that introduce what follows."""
    card = TextColumn(pen, width)
    card.text(text, 13, theme.DIM)
    return card.drawn()


def bar(width: int, share: float, color: Color, height: int = 10) -> pygame.Surface:
    """Draw a bar from the middle: to the right if positive, to the left if negative."""
    image = pygame.Surface((width, height))
    image.fill(theme.RAISED)
    middle = width // 2
    length = round(min(abs(share), 1.0) * middle)
    image.fill(color, (middle if share >= 0 else middle - length, 0, length, height))
    image.fill(theme.AXIS, (middle, 0, 1, height))
    return image
