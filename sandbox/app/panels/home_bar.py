"""The bar below the cards of the levels: a button that leads back, and a hint."""

import pygame
from pygame_gui import UIManager

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.panels.button_bar import MARGIN, Bar
from sandbox.app.runs.session import Session
from sandbox.app.words import level_translation
from sandbox.app.words.language import later, say

TITLE = 260  # px, the largest width of the title on the button that leads back
WAYS: tuple[tuple[str, str], ...] = (("challenges", later("Challenges")), ("help", later("Help")))
HINTS = (
    later("Click a level to open it. Rest the mouse on one to see it play."),
    later("Click a level to open it."),
)


class HomeBar(Bar):
    """A button that leads back to the open level, and a hint; no buttons for the hidden run."""

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session | None
    ) -> None:
        super().__init__(manager, pen, rect)
        px = pen.px
        self._left, self._right = px(MARGIN), rect.width - px(MARGIN)
        for command, text in reversed(WAYS):
            width = self._room(say(text))
            self._right -= px(width)
            self._button(command, say(text), self._right, width)
            self._right -= px(MARGIN)
        if session is not None:
            title = level_translation.title_of_level(session.original)
            back = say("Go to {title}", title=pen.shorten(title, px(TITLE)))
            self._left = self._button(
                "home", back, self._left, self._room(back, main=True), main=True
            )

    def draw(self, surface: pygame.Surface, session: Session | None) -> None:
        """Draw the background, and the longest hint that fits."""
        super().draw(surface, session)
        room = self._right - self._left - 2 * self._pen.px(MARGIN)
        written = (self._pen.write(say(hint), 13, theme.DIM) for hint in HINTS)
        if hint := next((each for each in written if each.width <= room), None):
            left = self._left + self._pen.px(MARGIN)
            surface.blit(hint, hint.get_rect(midleft=(left, self._rect.centery)))
