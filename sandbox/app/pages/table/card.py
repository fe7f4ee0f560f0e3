"""The values of the graphed quantities, a row for each of some instants."""

from collections.abc import Iterator, Mapping, Sequence

import pygame

from sandbox.app.cards.card import SMALLEST, Card
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.graph.card import measured
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.physics.accuracy.trusted_digits import Trust

ROWS = 24
"""About how many instants are shown, evenly spaced, the last one included."""

COLUMNS = 3
"""How many quantities fit beside the time; a file contains all of them."""

DIGITS = 4
"""How many digits are shown while the error is unknown; afterwards, those that can be trusted."""

SIZE = 12  # of letters
GAP = 10  # px, between columns
TIME = 64  # px, the column of the time


def values(
    pen: Pen, width: int, session: Session, names: Sequence[str], trust: Mapping[str, Trust]
) -> pygame.Surface:
    """Draw quantities by time.

    Parameters
    ----------
    pen, width
        The pen, and the width [px].
    session
        The session of the run.
    names
        The quantities; those for which there is no room are counted.
    trust
        How far they can be trusted, as far as that is known.
    """
    card, shown = Card(pen, width), names[:COLUMNS]
    card.heading(say("Values by time"))
    columns, units = measured(session.world, session.history, ["t", *shown])
    _row(card, ["t", *shown], theme.ACCENT)
    _row(card, ["s", *(units[n] for n in shown)], theme.DIM)
    for row in instants(len(columns["t"])):
        cells = (_cell(float(columns[n][row]), units[n], trust.get(n)) for n in shown)
        _row(card, [f"{columns['t'][row]:.4g}", *cells], theme.TEXT)
    if left := len(names) - len(shown):
        card.text(say("and {count} more in the file", count=left), 12, theme.DIM)
    card.text(say("The page Graph chooses what is shown (D)."), 12, theme.DIM)
    return card.drawn()


def instants(count: int) -> Iterator[int]:
    """Yield which of some instants are shown: evenly spaced, and the last one."""
    every = max(-(-count // ROWS), 1)
    yield from range(0, count - 1, every)
    yield count - 1


def _cell(value: float, unit: str, trust: Trust | None) -> str:
    """Write a value with the digits that mean something; the unit stands above."""
    if trust is not None:
        return formatting.certain(value, trust.off, unit).split(" ")[0]
    return formatting.quantity(value, unit, DIGITS).split(" ")[0]


def _row(card: Card, cells: Sequence[str], color: theme.Color) -> None:
    """Write a row: the first cell at the left, the others at the right of their columns."""
    first = card.pen.px(TIME)
    room = (card.width - first) / max(len(cells) - 1, 1)
    heights = []
    for i, text in enumerate(cells):
        shown = card.pen.shorten(text, int(room if i else first) - GAP, SIZE)
        image = card.pen.write(shown, SIZE, theme.DIM if i == 0 else color)
        card.put(image, 0 if i == 0 else first + round(i * room) - image.width)
        heights.append(image.height)
    card.y += max(heights, default=SMALLEST)
