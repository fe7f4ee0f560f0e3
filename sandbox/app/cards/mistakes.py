"""The card with the mistakes in a level's file, each below its position in the text."""

from collections.abc import Sequence
from itertools import pairwise

import pygame

from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen, legible
from sandbox.app.words.language import say
from sandbox.model.errors import Mistake
from sandbox.model.json_positions import TOKEN

AROUND = 2
"""Lines shown before and after a line with a mistake."""

AHEAD = 8
"""The least number of characters shown from the mistake on."""

SIZE = 13  # font size in an excerpt
PADDING = 10  # px
GUTTER = 14  # px, between a line's number and its text
LONGEST = 400
"""The number of characters of a line that are drawn: as many as the widest window shows."""


def groups(mistakes: Sequence[Mistake]) -> list[list[Mistake]]:
    """Group mistakes that are close enough in the text for a common excerpt."""
    found: list[list[Mistake]] = [[mistakes[0]]] if mistakes else []
    for before, after in pairwise(mistakes):
        near = before.line and after.line and after.line - before.line <= 2 * AROUND + 1
        if near:
            found[-1].append(after)
        else:
            found.append([after])
    return found


def excerpt(
    pen: Pen, width: int, lines: Sequence[str], mistakes: Sequence[Mistake]
) -> pygame.Surface:
    """Draw the lines around a group of mistakes, with a caret and a message at each.

    `lines` are those of the file, none if it cannot be read. The mistakes are in the order of the
    text.
    """
    card = TextColumn(pen, width)
    card.y = PADDING
    places = [mistake.line for mistake in mistakes if mistake.line]
    shown = range(max(min(places) - AROUND, 1), max(places) + AROUND + 1) if places else range(0)
    sheet = _Sheet(card, len(str(shown.stop)))
    for number in shown:
        text = lines[number - 1] if number <= len(lines) else ""
        sheet.put(number, text, [mistake for mistake in mistakes if mistake.line == number])
    for mistake in mistakes:
        if mistake.line is None:
            card.text(say(mistake.unplaced), SIZE + 1, theme.TEXT, indent=PADDING)
    card.y += PADDING
    drawn = card.drawn()
    pygame.draw.rect(drawn, theme.EDGE, drawn.get_rect(), 1, border_radius=5)
    return drawn


class _Sheet:
    """Lines of a text with their numbers, and carets between them."""

    def __init__(self, card: TextColumn, digits: int) -> None:
        self._card, self._pen = card, card.pen
        self._font = card.pen.spare(SIZE)
        self._left = PADDING + self._font.size("0" * digits)[0] + GUTTER
        self._room = max(card.width - self._left - PADDING, 1)
        self._wide = self._room // self._font.size("0")[0]  # characters per line
        self._begin = 0  # index of the first visible character of the line

    def put(self, number: int, text: str, mistakes: Sequence[Mistake]) -> None:
        """Add a line and its messages; repeat the line for a mistake beyond its visible part."""
        for i, mistake in enumerate(mistakes):
            column = (mistake.column or 1) - 1
            if i == 0 or not self._begin <= column < self._begin + self._wide:
                self._line(number, text, column)
            self._message(mistake, text, column)
        if not mistakes:
            self._line(number, text)

    def _line(self, number: int, text: str, column: int = -1) -> None:
        """Add a line of the text, scrolled so that the mistake is visible."""
        wrong = column >= 0
        hidden = wrong and column > self._wide - AHEAD
        self._begin = max(column - self._wide // 2, 0) if hidden else 0
        number_image = self._font.render(str(number), True, theme.FAILED if wrong else theme.AXIS)
        self._card.put(number_image, self._left - GUTTER - number_image.width)
        cut = legible(text[self._begin : self._begin + LONGEST])
        drawn = pygame.Surface((self._room, self._font.get_linesize()), pygame.SRCALPHA)
        if self._font.size(cut)[0]:
            drawn.blit(self._font.render(cut, True, theme.TEXT if wrong else theme.DIM), (0, 0))
        self._card.put(drawn, self._left)
        self._card.y += drawn.height

    def _message(self, mistake: Mistake, text: str, start: int) -> None:
        """Add a caret below a position of the line above, with the message beside or below it."""
        token = TOKEN.match(text, start)
        before = text[self._begin : start]
        marked = text[start : min(token.end() if token else start, start + LONGEST)] or " "
        x = self._left + self._font.size(legible(before))[0]
        end = min(x + self._font.size(legible(marked))[0], self._card.width - PADDING)
        caret = pygame.Surface((max(end - x, 6), 8), pygame.SRCALPHA)
        caret.fill(theme.FAILED, (0, 2, caret.width, 2))
        pygame.draw.polygon(caret, theme.FAILED, [(0, 7), (3, 0), (6, 7)])
        self._card.put(caret, x)
        message, room = say(mistake.unplaced), self._card.width - PADDING
        beside = caret.width + x + PADDING
        fits = self._pen.write(message, SIZE, theme.FAILED).width <= room - beside
        if not fits:
            self._card.y += caret.height + 1
        self._card.text(message, SIZE, theme.FAILED, indent=beside if fits else self._left)
        self._card.y += 2
