"""A text field of one line."""

import pygame
from pygame_gui.core.utility import clipboard_paste
from pygame_gui.elements import UITextEntryLine

from sandbox.app.drawing.text import typed

LONGEST = 100
"""The largest number of characters that are pasted."""


class TextField(UITextEntryLine):
    """A line of text that accepts every character that can be drawn.

    pygame_gui accepts characters without width, and fails to draw them. It also refuses all pasted
    text because of one invalid character; here only that one is left out. The click that enters a
    field selects its text, so that typing replaces it.
    """

    _entering = False

    def focus(self) -> None:
        """Give the field the keyboard focus."""
        super().focus()  # type: ignore[no-untyped-call]
        self._entering = True

    def _process_mouse_button_event(self, event: pygame.Event) -> bool:
        consumed = bool(super()._process_mouse_button_event(event))
        if event.type == pygame.MOUSEBUTTONUP and self._entering:
            self._entering = False
            if self.select_range[0] == self.select_range[1]:
                self.select_range = [0, len(self.text)]
        return consumed

    @property
    def selected(self) -> bool:
        """Whether there is text, and all of it is selected."""
        return bool(self.text) and sorted(self.select_range) == [0, len(self.text)]

    def _process_entered_character(self, character: str) -> bool:
        letter = typed(character)
        if letter == " " and self.selected:  # no text may begin with a space
            return False
        return bool(letter) and bool(super()._process_entered_character(letter))

    def _do_paste(self) -> None:
        room = LONGEST if self.length_limit is None else self.length_limit
        pasted = str(clipboard_paste() or "")  # type: ignore[no-untyped-call]
        for letter in typed(pasted[:LONGEST])[:room]:
            self._process_entered_character(letter)
