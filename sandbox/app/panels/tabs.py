"""The tabs of the pages, in as few rows as their captions allow."""

from collections.abc import Iterator, Sequence
from itertools import accumulate, combinations, pairwise

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app.drawing.text import Pen
from sandbox.app.keymap import tip
from sandbox.app.pages.page import Page
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed, stretched
from sandbox.app.words.language import say

HEIGHT = 26  # px, of a tab
GAP = 4  # px, between two
PADDING = 10  # px, beside a caption, left and right together
SIZE = 12  # of the captions, as for @tab in widgets.json
TOP = 10  # px, above the first row


class Tabs:
    """A button for each page."""

    def __init__(
        self, manager: UIManager, pen: Pen, area: pygame.Rect, pages: Sequence[Page], chosen: str
    ) -> None:
        self._pages: dict[UIButton, str] = {}
        px = pen.px
        self.bottom = px(TOP)
        """Their lower edge [px]."""
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
                show_pressed(tab, page.command == chosen)
                self._pages[tab] = page.command
                x += width + px(GAP)
            self.bottom += px(HEIGHT) + px(GAP)

    def pressed(self, element: object) -> str | None:
        """Return the command of a tab; None for another widget."""
        return next((page for tab, page in self._pages.items() if tab is element), None)

    def tab(self, page: str) -> UIButton:
        """Return the tab of a page, given by its command."""
        return next(tab for tab, command in self._pages.items() if command == page)


def rows(pen: Pen, pages: Sequence[Page], width: int) -> list[Sequence[Page]]:
    """Divide the pages into as few rows as a width [px] allows, about equally full."""
    gap = pen.px(GAP)
    ends = list(accumulate((_width(pen, page) + gap for page in pages), initial=0))

    def longest(row_ends: Sequence[int]) -> int:  # px
        return max(ends[b] - ends[a] for a, b in pairwise(row_ends)) - gap

    for count in range(1, len(pages) + 1):
        row_ends = min(_divisions(len(pages), count), key=longest)
        if longest(row_ends) <= width:
            return [pages[a:b] for a, b in pairwise(row_ends)]
    return [[page] for page in pages]


def _divisions(pages: int, count: int) -> Iterator[tuple[int, ...]]:
    """Yield all divisions of pages into rows, as the indices of the row starts and the end."""
    for breaks in combinations(range(1, pages), count - 1):
        yield 0, *breaks, pages


def _width(pen: Pen, page: Page) -> int:
    return pen.write(say(page.caption), SIZE).width + pen.px(PADDING)
