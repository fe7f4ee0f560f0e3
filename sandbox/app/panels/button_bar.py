"""The base of all bars at the bottom of the window: buttons for commands, on a background."""

from collections.abc import Mapping

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.keymap import tip
from sandbox.app.runs.session import Session

HEIGHT = 34  # px, of a button
GAP = 6  # px
MARGIN = 12  # px
PADDING = 22  # px, beside the caption of a button, left and right together


class Bar:
    """Buttons for commands, in a place of the window [px]."""

    def __init__(self, manager: UIManager, pen: Pen, rect: pygame.Rect) -> None:
        self._manager, self._pen, self._rect = manager, pen, rect
        self._buttons: dict[str, UIButton] = {}

    def _room(self, *captions: str, main: bool = False) -> int:
        """Return the width of a button that has room for any of its captions, at scale 1 [px]."""
        widest = max(self._pen.write(each, bold=main).width for each in captions)
        return round(widest / self._pen.scale) + PADDING

    def _button(self, command: str, text: str, x: int, width: int, *, main: bool = False) -> int:
        """Make a button, and return the left edge of the next one [px]."""
        width, height = self._pen.px(width), self._pen.px(HEIGHT)
        place = pygame.Rect(x, self._rect.y + (self._rect.height - height) // 2, width, height)
        self._buttons[command] = UIButton(
            place, text, self._manager, tool_tip_text=tip(command),
            object_id=ObjectID(class_id="@main") if main else None,
        )  # fmt: skip
        return x + width + self._pen.px(GAP)

    def button(self, command: str) -> UIButton:
        """Return the button of a command."""
        return self._buttons[command]

    def process(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        pressed = (c for c, button in self._buttons.items() if button is event.ui_element)
        return next(pressed, None)

    def clicked_share(self, _event: pygame.event.Event) -> float | None:
        """Return the share of the run that was clicked or dragged to, from 0 to 1; None if none."""
        return None

    def update(self, session: Session | None, shown: Mapping[str, bool]) -> None:
        """Update the buttons."""

    def draw(self, surface: pygame.Surface, session: Session | None) -> None:  # noqa: ARG002
        """Draw the background; the manager draws the buttons."""
        surface.fill(theme.PANEL, self._rect)
        surface.fill(theme.EDGE, (*self._rect.topleft, self._rect.width, 1))
