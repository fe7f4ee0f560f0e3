"""The tabs of the pages: in as many rows as their captions need, and none of them cut."""

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app.commands import tip
from sandbox.app.language import say
from sandbox.app.pages.page import Page
from sandbox.app.text import Pen
from sandbox.app.widgets.gui import press, stretched

HEIGHT = 26  # px, of a tab
GAP = 4  # px, between two
PADDING = 10  # px, beside a caption, left and right together
SIZE = 12  # of the captions, as widgets.json says for @tab
TOP = 10  # px, above the first row


class Tabs:
    """A button for each page.

    Attributes
    ----------
    bottom
        Where they end [px].
    """

    def __init__(
        self, manager: UIManager, pen: Pen, area: pygame.Rect, pages: Sequence[Page], chosen: str
    ) -> None:
        self._pages: dict[UIButton, str] = {}
        px = pen.px
        self.bottom = px(TOP)
        for row in rows(pen, pages, area.width):
            room = area.width - px(GAP) * (len(row) - 1)
            widths = stretched([_width(pen, page) for page in row], room)
            x = area.x
            for page, width in zip(row, widths, strict=True):
                place = pygame.Rect(x, self.bottom, width, px(HEIGHT))
                tab = UIButton(
                    place, say(page.caption), manager, tool_tip_text=tip(page.command),
                    object_id=ObjectID(class_id="@tab"),
                )  # fmt: skip
                press(tab, page.command == chosen)
                self._pages[tab] = page.command
                x += width + px(GAP)
            self.bottom += px(HEIGHT) + px(GAP)

    def pressed(self, element: object) -> str | None:
        """Return the command of the tab that a widget is; None if it is none."""
        return next((page for tab, page in self._pages.items() if tab is element), None)

    def tab(self, page: str) -> UIButton:
        """Return the tab of a page, given by its command."""
        return next(tab for tab, command in self._pages.items() if command == page)


def rows(pen: Pen, pages: Sequence[Page], width: int) -> list[Sequence[Page]]:
    """Part the pages into as few rows as a width [px] allows, about equally full."""
    for count in range(1, len(pages) + 1):
        parted = min(_parted(pages, count), key=lambda rows: max(_length(pen, r) for r in rows))
        if all(_length(pen, row) <= width for row in parted):
            return parted
    return [[page] for page in pages]


def _parted(pages: Sequence[Page], count: int) -> Iterator[list[Sequence[Page]]]:
    """Yield all ways to part the pages into so many rows."""
    for breaks in combinations(range(1, len(pages)), count - 1):
        yield [pages[a:b] for a, b in pairwise((0, *breaks, len(pages)))]


def _length(pen: Pen, row: Sequence[Page]) -> int:
    """Return the least length of a row [px]."""
    return sum(_width(pen, page) + pen.px(GAP) for page in row) - pen.px(GAP)


def _width(pen: Pen, page: Page) -> int:
    return pen.write(say(page.caption), SIZE).width + pen.px(PADDING)
