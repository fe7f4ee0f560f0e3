"""The key of an overlay: what its colours, signs and lengths mean, in the lower left corner."""

from collections.abc import Callable, Sequence

import pygame

from sandbox.app.drawing import theme
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.model.shapes import XY

MARGIN = 8  # px, from the corner
SAMPLE = 46  # px, the width of a sample
SIZES = 12, 10, 8  # px, of letters
HIGHER = 18
"""The number of rows by which a key may stand above others."""

Row = tuple[Callable[[pygame.Surface, XY, XY], None], str]
"""A function that draws a sample between two points [px], and the text beside it."""


def draw(surface: pygame.Surface, view: DrawingContext, rows: Sequence[Row], name: str) -> None:
    """Draw a key of some rows, above any other there; it is left out if there is no room.

    Text that is too wide for the stage is written smaller.
    """
    wide = view.pen.px(SAMPLE)
    for letters in SIZES:
        texts = [view.pen.write(text, letters) for _, text in rows]
        width = wide + 3 * MARGIN + max(text.width for text in texts)
        if width + MARGIN <= view.labels.bounds.width:
            break
    high = max(text.height for text in texts) + 2
    size = width, len(rows) * high + MARGIN
    corner = view.labels.bounds.move(MARGIN, -MARGIN).bottomleft
    lowest = pygame.Rect((0, 0), size).move_to(bottomleft=corner)
    box = view.labels.place_for([lowest.move(0, -i * high) for i in range(HIGHER)], name=name)
    if box is None:
        return
    pygame.draw.rect(surface, theme.PANEL, box, border_radius=6)
    pygame.draw.rect(surface, theme.EDGE, box, 1, border_radius=6)
    y = box.top + MARGIN // 2
    for (sample, _), text in zip(rows, texts, strict=True):
        middle = y + high // 2
        sample(surface, (box.left + MARGIN, middle), (box.left + MARGIN + wide, middle))
        surface.blit(text, (box.left + 2 * MARGIN + wide, y + 1))
        y += high
