"""The messages over the stage: banners, the help, and offers."""

from collections.abc import Iterator, Sequence
from math import ceil

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.keymap import BINDINGS
from sandbox.app.window_keys import MOUSE
from sandbox.app.words.language import say, say_in

PADDING = 12  # px
NARROWEST = 60  # px, the least width of the text of a note
HIDDEN = 0.25
"""The share of an area that a note may hide before its text is made smaller."""
OFFER = 220, 38  # px
ROW = 17  # px, the least height of a row of the help
LEGIBLE = 0.75
"""The smallest scale at which the help is legible."""


def draw_banner(
    surface: pygame.Surface, pen: Pen, area: pygame.Rect, text: str, color: Color
) -> int:
    """Draw a note at the top of an area, and return its lower edge [px]."""
    lines = _lines(pen, area, text)
    width = max(line.width for line in lines) + 2 * PADDING + 6
    height = sum(line.height for line in lines) + 2 * PADDING - 6
    box = pygame.Rect(0, 0, width, height)
    box.midtop = area.centerx, area.y + 14
    pygame.draw.rect(surface, theme.RAISED, box, border_radius=6)
    pygame.draw.rect(surface, color, box, 1, border_radius=6)
    surface.fill(color, (box.x + 1, box.y + 6, 3, box.height - 12))
    y = box.y + PADDING - 3
    for line in lines:
        surface.blit(line, (box.x + PADDING + 3, y))
        y += line.height
    return box.bottom


def _lines(pen: Pen, area: pygame.Rect, text: str) -> Sequence[pygame.Surface]:
    """Return the lines of a note, smaller if it would hide too much of the area."""
    width = max(min(area.width - 2 * PADDING - 20, pen.px(640)), pen.px(NARROWEST))
    lines = pen.paragraph(text, width, 14, theme.TEXT)
    if sum(line.height for line in lines) > HIDDEN * area.height:
        lines = pen.paragraph(text, width, 11, theme.TEXT)
    return lines


def window_keys_and_mouse() -> list[tuple[str, str]]:
    """Return the keys of the window and the uses of the mouse on the stage, with descriptions."""
    return [*((binding.shown, binding.text) for binding in BINDINGS), ("", ""), *MOUSE]


def draw_help(
    surface: pygame.Surface, pen: Pen, area: pygame.Rect, rows: Sequence[tuple[str, str]],
    number: int = 1,
) -> int:  # fmt: skip
    """Draw a table of keys in the middle of an area, and return its number of sheets.

    The table has one or two columns, scaled down if necessary. If it would not be legible then, it
    is divided into several sheets, of which the sheet `number` is drawn.
    """
    px = pen.px
    columns = 1 if (area.height - px(110)) // len(rows) >= px(ROW) else 2
    each = ceil(len(rows) / columns)
    height = min(max((area.height - px(110)) // each, px(ROW)), px(22))
    size = 14 if columns == 1 and height >= px(20) else 12
    tables = [_table(pen, part, height, size) for part in _parts(rows, each)]
    if _shrinking(surface, pen, area, tables) < LEGIBLE:
        each = max((area.height - px(110)) // px(ROW), 1)
        tables = [_table(pen, part, px(ROW), 12) for part in _parts(rows, each)]
        sheets = [[table] for table in tables]
    else:
        sheets = [tables]
    number = min(number, len(sheets))
    title = say("Keys and mouse")
    if len(sheets) > 1:
        title = say(
            "{title}, {number} of {count}: H goes on", title=title, number=number, count=len(sheets)
        )
    sheet, scale = (
        _sheet(pen, title, sheets[number - 1]),
        _shrinking(surface, pen, area, sheets[number - 1]),
    )
    if scale < 1:
        sheet = pygame.transform.smoothscale_by(sheet, scale)
    surface.blit(sheet, sheet.get_rect(center=area.center).clamp(surface.get_rect()))
    return len(sheets)


def _parts(rows: Sequence[tuple[str, str]], each: int) -> Iterator[Sequence[tuple[str, str]]]:
    for first in range(0, len(rows), each):
        yield rows[first : first + each]


def _extent(pen: Pen, tables: Sequence[pygame.Surface]) -> tuple[int, int]:
    """Return the size of a sheet with tables side by side [px]."""
    px = pen.px
    wide = sum(table.width + px(24) for table in tables) + px(24)
    return wide, max(table.height for table in tables) + px(70)


def _shrinking(
    surface: pygame.Surface, pen: Pen, area: pygame.Rect, tables: Sequence[pygame.Surface]
) -> float:
    """Return the scale at which a sheet fits."""
    wide, high = _extent(pen, tables)
    return min(surface.width / wide, area.height / high, 1.0)


def _sheet(pen: Pen, title: str, tables: Sequence[pygame.Surface]) -> pygame.Surface:
    """Draw tables side by side, below a title."""
    px = pen.px
    sheet = pygame.Surface(_extent(pen, tables), pygame.SRCALPHA)
    pygame.draw.rect(sheet, theme.PANEL, sheet.get_rect(), border_radius=8)
    pygame.draw.rect(sheet, theme.ACCENT, sheet.get_rect(), 1, border_radius=8)
    sheet.blit(pen.write(title, 18, bold=True), (px(24), px(16)))
    x = px(24)
    for table in tables:
        sheet.blit(table, (x, px(52)))
        x += table.width + px(24)
    return sheet


def _table(pen: Pen, rows: Sequence[tuple[str, str]], height: int, size: int) -> pygame.Surface:
    """Draw keys and their descriptions, one row each."""
    keys = [pen.write(say_in("key", key), size, theme.ACCENT, True) for key, _ in rows]
    texts = [pen.write(say(text), size) for _, text in rows]
    left = max(key.width for key in keys) + pen.px(28)
    table = pygame.Surface((left + max(text.width for text in texts), len(rows) * height))
    table.fill(theme.PANEL)
    for i, (key, text) in enumerate(zip(keys, texts, strict=True)):
        table.blits([(key, (0, i * height)), (text, (left, i * height))])
    return table


def offer(manager: UIManager, pen: Pen, stage: pygame.Rect, rate: float) -> UIButton:
    """Return a button that offers to run again at a rate at which the run should not fail."""
    box = pygame.Rect((0, 0), (pen.px(OFFER[0]), pen.px(OFFER[1])))
    box.midbottom = stage.centerx, stage.bottom - 16
    return UIButton(
        box, say("Run at {rate:,.0f} Hz", rate=rate), manager, object_id=ObjectID(class_id="@main")
    )
