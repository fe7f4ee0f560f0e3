"""The legend of the runs that are drawn together on the stage, by their colours."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pygame

from sandbox.app.drawing import line_styles, lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.label_placement import Labels
from sandbox.app.words.language import say
from sandbox.model.shapes import XY

if TYPE_CHECKING:
    from sandbox.app.stage.drawing_context import DrawingContext

CORNER = 44, 62  # px, clear of the ruler and of a banner of one line
GAP = 8  # px, below a banner of several lines, and from the right edge
LOW = 44  # px, from the lower edge, above the ruler
SWATCH = 26  # px
PADDING = 8  # px
LegendRow = tuple[Color | None, str]
"""A colour (None for the run that is played), and the caption of what is drawn in it."""

SIZES = 14, 11
"""The sizes of the text; the next one is taken if there is no place clear of bodies."""

LEVELS = 8
"""The number of heights at which a place beside the corners is looked for."""

COLORS = 4
"""The largest number of bodies' colours that are shown for the current run."""


def earlier(texts: Sequence[str]) -> Sequence[LegendRow]:
    """Return rows for the current run and each earlier one; none without earlier runs."""
    rows = [(theme.LANES[i % len(theme.LANES)], text) for i, text in enumerate(texts)]
    return [(None, say("this run")), *rows] if rows else []


def draw(
    surface: pygame.Surface, pen: Pen, rows: Sequence[LegendRow], banner: int = 0,
    view: "DrawingContext | None" = None,
) -> None:  # fmt: skip
    """Draw a row for each run in a corner, below the banner, where it covers no moving body.

    It stays in its corner until bodies come there. If no corner is clear, it stands elsewhere, or
    is written smaller. The current run has no colour of its own, but those of the bodies in the
    view. Long texts are shortened; the side panel shows them in full. Nothing is drawn if there is
    no room below the banner, which ends at a height [px].
    """
    if not rows:
        return
    found = _placed(surface, pen, [text for _, text in rows], max(CORNER[1], banner + GAP), view)
    if found is None:
        return
    box, texts = found
    height = _row_height(texts)
    pygame.draw.rect(surface, theme.PANEL, box, border_radius=6)
    pygame.draw.rect(surface, theme.EDGE, box, 1, border_radius=6)
    x, y = box.x + PADDING, box.y + PADDING
    for place, ((color, _), text) in enumerate(zip(rows, texts, strict=True)):
        ends = (x, y + height // 2), (x + SWATCH, y + height // 2)
        if color is None:
            own = view.colors[:COLORS] if view else ()
            _stroke(surface, own or (theme.ACCENT,), *ends)
        else:
            lines.dashed(surface, color, ends, *line_styles.dash(place - 1))
        surface.blit(text, (x + SWATCH + 10, y))
        y += height


def _placed(
    surface: pygame.Surface, pen: Pen, texts: Sequence[str], top: int, view: "DrawingContext | None"
) -> tuple[pygame.Rect, Sequence[pygame.Surface]] | None:
    """Return the box of the legend, below a height [px], and its texts; None without room."""
    beside = SWATCH + 10 + 2 * PADDING
    room, bodies = surface.width - CORNER[0] - beside - GAP, view.boxes if view and view.few else ()
    labels = Labels(surface.get_rect(), view.kept if view else None)
    for size, strict in ((SIZES[0], True), (SIZES[1], True), (SIZES[0], False)):
        written = [pen.write(pen.shorten(text, room, size), size) for text in texts]
        box = max(each.width for each in written) + beside, len(texts) * _row_height(written)
        places = _places(surface.get_rect(), (box[0], box[1] + 2 * PADDING), top)
        place = labels.place_for(places, bodies, name=f"legend {size}", strict=strict)
        if place is not None:
            return place, written
    return None


def _row_height(texts: Sequence[pygame.Surface]) -> int:
    return texts[0].height + 2


def _places(bounds: pygame.Rect, size: tuple[int, int], top: int) -> Sequence[pygame.Rect]:
    """Return the places for a legend of some size: three corners, and then beside the edges."""
    left = pygame.Rect((CORNER[0], top), size)
    columns = left, left.move_to(right=bounds.right - GAP), left.move_to(centerx=bounds.centerx)
    free = bounds.bottom - LOW - left.bottom
    heights = [top + free * i // LEVELS for i in range(LEVELS + 1)]
    corners = *columns[:2], left.move_to(bottom=bounds.bottom - LOW)
    others = [column.move_to(top=height) for height in heights for column in columns]
    return [each for each in (*corners, *others) if each.top >= top]


def _stroke(surface: pygame.Surface, colors: Sequence[Color], start: XY, end: XY) -> None:
    """Draw a horizontal line with a piece in each colour."""
    piece = (end[0] - start[0]) / len(colors)
    for i, color in enumerate(colors):
        x = start[0] + i * piece
        lines.stroke(surface, color, (x, start[1]), (x + piece, end[1]), 3)
