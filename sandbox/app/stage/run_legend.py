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

    It stays in its corner until bodies come there. The current run has no colour of its own, but
    those of the bodies in the view. Long texts are shortened; the side panel shows them in full.
    Nothing is drawn if there is no room below the banner, which ends at a height [px].
    """
    if not rows:
        return
    beside = SWATCH + 10 + 2 * PADDING
    room = surface.width - CORNER[0] - beside - GAP
    texts = [pen.write(pen.shorten(text, room), 14) for _, text in rows]
    height = texts[0].height + 2
    size = max(text.width for text in texts) + beside, len(texts) * height + 2 * PADDING
    box = _place(surface.get_rect(), size, max(CORNER[1], banner + GAP), view)
    if box is None:
        return
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


def _place(
    bounds: pygame.Rect, size: tuple[int, int], top: int, view: "DrawingContext | None"
) -> pygame.Rect | None:
    """Return the box of the legend, of some size, below a height [px]; None without room."""
    left = pygame.Rect((CORNER[0], top), size)
    places = left, left.move_to(right=bounds.right - GAP), left.move_to(bottom=bounds.bottom - LOW)
    labels = Labels(bounds, view.kept if view else None)
    bodies = view.boxes if view and view.few else ()
    return labels.place_for((each for each in places if each.top >= top), bodies, name="legend")


def _stroke(surface: pygame.Surface, colors: Sequence[Color], start: XY, end: XY) -> None:
    """Draw a horizontal line with a piece in each colour."""
    piece = (end[0] - start[0]) / len(colors)
    for i, color in enumerate(colors):
        x = start[0] + i * piece
        lines.stroke(surface, color, (x, start[1]), (x + piece, end[1]), 3)
