"""The scrolling part of the side panel, which holds the contents of a page."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID, UIContainer
from pygame_gui.elements import UIButton, UIImage, UIScrollingContainer, UISelectionList

from sandbox.app.drawing.text import Pen
from sandbox.app.widgets.parameter_sliders import ParameterSliders
from sandbox.app.words.level_translation import Say
from sandbox.model.expressions import Values
from sandbox.model.level import Parameter

MARGIN = 16  # px
BAR = 26  # px, reserved for the scroll bar
PADDING = 26  # px, beside a caption, total of left and right


class FieldsPanel(Protocol):
    """Fields that can be typed into."""

    def revert(self) -> None:
        """Reset the fields to the current values."""


class Sheet:
    """An area that scrolls if its contents do not fit."""

    def __init__(self, manager: UIManager, pen: Pen, rect: pygame.Rect) -> None:
        self.manager, self.pen = manager, pen
        self.margin = pen.px(MARGIN)
        """The left margin, which is twice the upper one [px]."""
        self.width = rect.width - self.margin - pen.px(BAR)
        """The width of the contents [px]."""
        self.height = rect.height
        """The height of the area [px]."""
        self._rect = rect
        self.strip = UIContainer(pygame.Rect(rect.topleft, (rect.width, 1)), manager)
        """The strip above the area, which does not scroll; without height unless a page pins it."""
        self.container = UIScrollingContainer(rect, manager, allow_scroll_x=False)
        """The container of pygame_gui."""
        nowhere = pygame.Rect(0, 0, 0, 0)
        self.parameters = ParameterSliders(manager, pen, self.container, nowhere, {}, {})
        """The fields and sliders of parameters; empty unless a page adds some."""
        self.checks: UIImage | None = None
        """The picture of the checks; None unless a page adds it."""
        self.typed: FieldsPanel | None = None
        """Other fields that can be typed into, instead of parameters; None unless a page adds
        some."""

    def px(self, length: float) -> int:
        """Return a length, given at the standard scale, at the current one [px]."""
        return self.pen.px(length)

    def scaled(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return a size, given at the standard scale, at the current one [px]."""
        return self.px(size[0]), self.px(size[1])

    def image(self, surface: pygame.Surface, y: int) -> UIImage:
        """Add a picture at a height [px]."""
        rect = pygame.Rect((self.margin, y), surface.size)
        return UIImage(rect, surface, self.manager, container=self.container)

    def button(self, rect: pygame.Rect, text: str, tip: str, kind: str | None = None) -> UIButton:
        """Add a button; its rectangle is relative to the left margin [px]."""
        return UIButton(
            rect.move(self.margin, 0), text, self.manager,
            container=self.container, tool_tip_text=tip,
            object_id=ObjectID(class_id=kind) if kind else None,
        )  # fmt: skip

    def choices(
        self, names: Sequence[str], height: int, chosen: str | Sequence[str] | None
    ) -> UISelectionList:
        """Add a list of names with a height [px]; several can be chosen if `chosen` is no text."""
        return UISelectionList(
            pygame.Rect(self.margin, 0, self.width, height), [*names], self.manager,
            container=self.container, allow_double_clicks=False,
            allow_multi_select=not isinstance(chosen, str | None),
            default_selection=chosen if isinstance(chosen, str | None) else [*chosen],
        )  # fmt: skip

    def add_parameters(
        self, y: int, parameters: Mapping[str, Parameter], values: Values, words: Say
    ) -> ParameterSliders:
        """Add fields and sliders of parameters at a height [px]."""
        area = pygame.Rect(self.margin, y, self.width, 0)
        found = ParameterSliders(
            self.manager, self.pen, self.container, area, parameters, values, words
        )
        self.parameters = found
        return found

    def widest_button(self, *captions: str) -> int:
        """Return the width that a button needs for the widest of some captions [px]."""
        return max(self.pen.write(each, 14).width for each in captions) + self.px(PADDING)

    @staticmethod
    def replace(image: UIImage, surface: pygame.Surface) -> None:
        """Replace a picture by another one."""
        if image.relative_rect.size != surface.size:
            image.set_dimensions(surface.size)
        image.set_image(surface)

    def set_strip_height(self, height: int) -> None:
        """Set the height of the strip above [px]."""
        if self.strip.rect.height == height:
            return
        rect = self._rect
        self.strip.set_dimensions((rect.width, height))
        self.container.set_relative_position((rect.x, rect.y + height))
        self.container.set_dimensions((rect.width, max(rect.height - height, 1)))

    def set_content_height(self, height: int) -> None:
        """Set the height of the contents [px]."""
        if self.container.scrollable_container.rect.height != height:
            self.container.set_scrollable_area_dimensions((self.width + self.margin, height))


class Panel(Protocol):
    """The contents of a page on its sheet."""

    def process(self, event: pygame.event.Event) -> str | None:
        """Handle a click; return the message for it, or None if nothing was clicked.

        A `SandboxError` is shown as a message.
        """

    def update(self) -> None:
        """Update the contents."""


def in_rows(widths: Iterable[int], room: int, height: int, gap: int) -> Iterator[pygame.Rect]:
    """Yield places with some widths side by side, as many in a row as there is room for [px]."""
    x = y = 0
    for width in widths:
        if x and x + width > room:
            x, y = 0, y + height + gap
        yield pygame.Rect(x, y, width, height)
        x += width + gap


def below(image: UIImage) -> int:
    """Return the height of a picture's lower edge [px]."""
    return int(image.relative_rect.bottom)
