"""The layout of the cards: rows as wide as the area, below the headings of their chapters."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

from pygame import Rect

from sandbox.app.files.level_list_entries import Entry
from sandbox.app.words.language import say

MARGIN = 24  # px, around all cards
GAP = 16  # px, between two cards
NARROWEST = 190  # px, the least width of a card
MOST = 6
"""The most cards in a row."""
WORDS = 46  # px, the height of the text below a picture
HEADING = 46  # px
ASPECT = 1.6  # of a picture, width over height


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading above cards, with their number, and its position on the sheet [px]."""

    text: str
    count: int
    y: int


@dataclass(frozen=True, slots=True)
class CardGrid:
    """Cards on a sheet that may be higher than its visible part."""

    cards: tuple[tuple[Entry, Rect], ...]
    """The levels in order, with the rectangles of their cards on the sheet [px]."""
    headings: tuple[Heading, ...]
    """The headings above groups of cards."""
    picture: tuple[int, int]
    """The size of a card's picture [px]."""
    height: int
    """The height of the sheet [px]."""

    def at(self, point: tuple[float, float]) -> int | None:
        """Return the index of the card at a point of the sheet [px]; None if there is none."""
        return next(
            (i for i, (_, place) in enumerate(self.cards) if place.collidepoint(point)), None
        )

    def beside(self, index: int, dx: int, dy: int) -> int:
        """Return the index of the next card in a direction; the same if there is none."""
        if dx:
            return min(max(index + dx, 0), len(self.cards) - 1)
        rect = self.cards[index][1]
        rows = sorted({place.y for _, place in self.cards if (place.y - rect.y) * dy > 0})
        if not rows:
            return index
        row = rows[0] if dy > 0 else rows[-1]
        found = [i for i, (_, place) in enumerate(self.cards) if place.y == row]
        return min(found, key=lambda i: abs(self.cards[i][1].x - rect.x))


def lay_out(
    width: int, sections: Iterable[tuple[str, Sequence[Entry]]], scale: float = 1.0
) -> CardGrid:
    """Lay out cards in rows on a sheet of some width [px], with a heading above each section."""
    margin, gap, narrowest, words, heading = (
        round(length * scale) for length in (MARGIN, GAP, NARROWEST, WORDS, HEADING)
    )
    room = max(width - 2 * margin, 1)
    columns = min(max((room + gap) // (narrowest + gap), 1), MOST)
    each = (room - (columns - 1) * gap) // columns
    picture = each, round(each / ASPECT)
    cards: list[tuple[Entry, Rect]] = []
    headings: list[Heading] = []
    y = gap // 2
    for text, levels in sections:
        headings.append(Heading(text, len(levels), y))
        y += heading
        for i, level in enumerate(levels):
            x = margin + i % columns * (each + gap)
            place = Rect(x, y + i // columns * (picture[1] + words + gap), each, picture[1] + words)
            cards.append((level, place))
        y += -(-len(levels) // columns) * (picture[1] + words + gap) + gap // 2
    return CardGrid(tuple(cards), tuple(headings), picture, y + gap)


def sections(found: Sequence[Entry], search: str) -> list[tuple[str, Sequence[Entry]]]:
    """Group levels by chapter; search results stay together, the best first."""
    if not search.strip():
        chapters = groupby(found, key=lambda level: level.chapter)
        return [(say(chapter.capitalize()), list(levels)) for chapter, levels in chapters]
    return [(say("Found") if found else say("No level matches"), found)]
