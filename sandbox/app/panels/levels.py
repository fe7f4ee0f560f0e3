"""The list of levels, by chapter."""

import json
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton, UIImage, UIScrollingContainer

from sandbox.app import theme
from sandbox.app.panels.widgets import press, scroll
from sandbox.app.text import Pen
from sandbox.model import catalog
from sandbox.model.errors import SandboxError

ROW = 28  # px
HEADING = 34  # px
MARGIN = 8  # px
SCROLL_BAR = 22  # px


class Entry(NamedTuple):
    """A level that can be chosen: its file, its chapter, and what it is called."""

    path: Path
    chapter: str
    title: str


def entries() -> list[Entry]:
    """Return the levels of the catalogue."""
    found = []
    for name in catalog.names():
        try:
            found.append(entry(catalog.find(name).resolve(), name.partition("/")[0]))
        except SandboxError:
            continue  # gone since it was listed
    return found


def entry(path: Path, chapter: str) -> Entry:
    """Return the entry of a file, whatever is in it."""
    try:
        title = str(json.loads(path.read_text(encoding="utf-8"))["title"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        title = path.stem  # why it cannot be read is told when it is opened
    return Entry(path, chapter, title)


class LevelList:
    """A column of buttons, one a level."""

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, levels: Sequence[Entry]
    ) -> None:
        self._buttons: dict[UIButton, Path] = {}
        self._container = UIScrollingContainer(rect, manager, allow_scroll_x=False)
        chapters = {level.chapter for level in levels}
        height = len(chapters) * HEADING + len(levels) * ROW + 2 * MARGIN
        width = rect.width - 2 * MARGIN - (SCROLL_BAR if height > rect.height else 0)
        self._container.set_scrollable_area_dimensions((width + MARGIN, height))
        y = MARGIN // 2
        for chapter, group in groupby(levels, key=lambda level: level.chapter):
            self._heading(manager, pen, chapter, y, width)
            y += HEADING
            for level in group:
                self._button(manager, pen, level, pygame.Rect(MARGIN, y, width, ROW))
                y += ROW

    def _heading(self, manager: UIManager, pen: Pen, chapter: str, y: int, width: int) -> None:
        image = pygame.Surface((width, HEADING))
        image.fill(theme.PANEL)
        image.blit(pen.write(chapter.capitalize(), 13, theme.ACCENT, True), (10, 12))
        UIImage(pygame.Rect(MARGIN, y, width, HEADING), image, manager, container=self._container)

    def _button(self, manager: UIManager, pen: Pen, level: Entry, rect: pygame.Rect) -> None:
        shown = pen.shorten(level.title, rect.width - 18, 13)
        button = UIButton(
            rect, shown, manager, container=self._container, object_id=ObjectID(class_id="@level"),
            tool_tip_text=None if shown == level.title else level.title,
        )  # fmt: skip
        self._buttons[button] = level.path

    def choose(self, path: Path | None) -> None:
        """Mark a level as the one that is played, and bring it into view."""
        for button, other in self._buttons.items():
            press(button, other == path)
            if other == path:
                scroll(self._container, button.relative_rect.y - self._container.rect.height / 2)

    def process(self, event: pygame.event.Event) -> Path | None:
        """Return the level that was clicked on, if one was."""
        if event.type == UI_BUTTON_PRESSED:
            return self._buttons.get(event.ui_element)
        return None

    def button(self, path: Path) -> UIButton:
        """Return the button of a level."""
        return next(button for button, other in self._buttons.items() if other == path)
