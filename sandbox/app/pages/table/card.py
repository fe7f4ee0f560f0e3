"""The table of the graphed quantities at selected instants."""

from collections.abc import Mapping, Sequence

import numpy as np
import pygame

from sandbox.app.cards.text_column import SMALLEST, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.graph.card import measured, value_at
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.physics.accuracy.trusted_digits import Trust

ROWS = 24
"""The largest number of instants shown, at round times, besides the last one."""
ROUNDING = 1e-9
"""The first time may be late by this fraction of an interval."""

COLUMNS = 3
"""The number of quantities that fit beside the time; a file contains all."""

DIGITS = 4
"""The number of digits shown while the error is unknown; then only accurate digits are shown."""

SIZE = 12  # of letters
GAP = 10  # px, between columns
TIME = 64  # px, the width of the column of the time


def values(
    pen: Pen, width: int, session: Session, names: Sequence[str], trust: Mapping[str, Trust]
) -> pygame.Surface:
    """Draw quantities by time; of those without room only the number is written."""
    card, shown = TextColumn(pen, width), names[:COLUMNS]
    card.heading(say("Values by time"))
    columns, units = measured(session.world, session.history, ["t", *shown])
    _row(card, ["t", *shown], theme.ACCENT)
    _row(card, ["s", *(formatting.shown_unit(units[n]) for n in shown)], theme.DIM)
    for row in instants(columns["t"]):
        cells = (_cell(value_at(columns[n], row), units[n], trust.get(n)) for n in shown)
        _row(card, [f"{columns['t'][row]:.4g}", *cells], theme.TEXT)
    if left := len(names) - len(shown):
        card.text(say("and {count} more in the file", count=left), 12, theme.DIM)
    card.text(say("The page Graph chooses what is shown (D)."), 12, theme.DIM)
    return card.drawn()


def instants(t: Array) -> Sequence[int]:
    """Return the indices of the instants shown: the first, the nearest to round times, the last.

    `t` are the recorded times: (k,) [s].
    """
    last, every = len(t) - 1, formatting.rounded_up(float(t[-1] - t[0]) / ROWS)
    if not every:
        return [last]
    wanted = np.arange(np.ceil(t[0] / every - ROUNDING), t[-1] / every) * every
    after = np.clip(np.searchsorted(t, wanted), 1, last)
    nearest = after - (wanted - t[after - 1] < t[after] - wanted)
    return [*dict.fromkeys([0, *nearest.tolist(), last])]


def _cell(value: float, unit: str, trust: Trust | None) -> str:
    """Return the text of a value with its accurate digits, without the unit."""
    text = formatting.quantity(value, unit, DIGITS)
    if trust is not None:
        text = formatting.trusted_value(value, trust.off, unit)
    return text.removesuffix(formatting.shown_unit(unit)).rstrip()


def _row(card: TextColumn, cells: Sequence[str], color: theme.Color) -> None:
    """Write a row: the first cell left-aligned, the others right-aligned in their columns."""
    first = card.pen.px(TIME)
    room = (card.width - first) / max(len(cells) - 1, 1)
    heights = []
    for i, text in enumerate(cells):
        shown = card.pen.shorten(text, int(room if i else first) - GAP, SIZE)
        image = card.pen.write(shown, SIZE, theme.DIM if i == 0 else color)
        card.put(image, 0 if i == 0 else first + round(i * room) - image.width)
        heights.append(image.height)
    card.y += max(heights, default=SMALLEST)
