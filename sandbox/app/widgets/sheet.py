"""The scrolling part of the side panel, on which a page puts its contents."""

from typing import Protocol

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID, UIContainer
from pygame_gui.elements import UIButton, UIImage, UIScrollingContainer

from sandbox.app.drawing.text import Pen
from sandbox.app.widgets.parameters import Parameters

MARGIN = 16  # px
BAR = 26  # px, kept free for the scroll bar
PADDING = 26  # px, beside a caption, left and right together


class Typed(Protocol):
    """Fields that can be typed into."""

    def revert(self) -> None:
        """Let the fields say again what is the case."""
        ...


class Sheet:
    """An area of some width that scrolls if it must.

    Attributes
    ----------
    width
        The width of its contents [px].
    margin
        Left of that, and twice what is above it [px].
    container
        pygame_gui's.
    strip
        What stays above it while it is scrolled; of no height unless a page pins some.
    parameters
        The parameters' fields and sliders; none unless a page puts some.
    checks
        The picture of the checks; None unless a page puts it.
    typed
        Other fields that can be typed into, in place of those; None unless a page puts some.
    """

    def __init__(self, manager: UIManager, pen: Pen, rect: pygame.Rect) -> None:
        self.manager, self.pen = manager, pen
        self.margin = pen.px(MARGIN)
        self.width = rect.width - self.margin - pen.px(BAR)
        self._rect = rect
        self.strip = UIContainer(pygame.Rect(rect.topleft, (rect.width, 1)), manager)
        self.container = UIScrollingContainer(rect, manager, allow_scroll_x=False)
        nowhere = pygame.Rect(0, 0, 0, 0)
        self.parameters = Parameters(manager, pen, self.container, nowhere, {}, {})
        self.checks: UIImage | None = None
        self.typed: Typed | None = None

    def px(self, length: float) -> int:
        """Return a length, given at the usual scale, at the present one [px]."""
        return self.pen.px(length)

    def scaled(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return a size, given at the usual scale, at the present one [px]."""
        return self.px(size[0]), self.px(size[1])

    def image(self, surface: pygame.Surface, y: int) -> UIImage:
        """Put a picture at a height."""
        rect = pygame.Rect((self.margin, y), surface.size)
        return UIImage(rect, surface, self.manager, container=self.container)

    def button(self, rect: pygame.Rect, text: str, tip: str, kind: str | None = None) -> UIButton:
        """Put a button, with its place relative to the left margin."""
        return UIButton(
            rect.move(self.margin, 0), text, self.manager,
            container=self.container, tool_tip_text=tip,
            object_id=ObjectID(class_id=kind) if kind else None,
        )  # fmt: skip

    def room(self, *captions: str) -> int:
        """Return how wide a button must be for any of some captions [px]."""
        return max(self.pen.write(each, 14).width for each in captions) + self.px(PADDING)

    @staticmethod
    def replace(image: UIImage, surface: pygame.Surface) -> None:
        """Let a picture show another one."""
        if image.relative_rect.size != surface.size:
            image.set_dimensions(surface.size)
        image.set_image(surface)

    def pin(self, height: int) -> None:
        """Let the strip above be so high [px]."""
        if self.strip.rect.height == height:
            return
        rect = self._rect
        self.strip.set_dimensions((rect.width, height))
        self.container.set_relative_position((rect.x, rect.y + height))
        self.container.set_dimensions((rect.width, max(rect.height - height, 1)))

    def end(self, height: int) -> None:
        """Let all be scrolled to, down to a height."""
        if self.container.scrollable_container.rect.height != height:
            self.container.set_scrollable_area_dimensions((self.width + self.margin, height))


class Panel(Protocol):
    """What a page of the side panel has put on its sheet."""

    def process(self, event: pygame.event.Event) -> str | None:
        """Handle a click; return the message for it, None if nothing was clicked."""
        ...

    def update(self) -> None:
        """Bring what is shown up to date."""
        ...


def below(image: UIImage) -> int:
    """Return the height at which a picture ends."""
    return int(image.relative_rect.bottom)
