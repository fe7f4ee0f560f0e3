"""A line to type into."""

from pygame_gui.core.utility import clipboard_paste
from pygame_gui.elements import UITextEntryLine

from sandbox.app.text import typed

LONGEST = 100
"""Letters: as much as anybody looks for."""


class Field(UITextEntryLine):
    """A line of text that takes whatever is typed or pasted, but for what cannot be drawn.

    pygame_gui keeps a letter without width, and ends when it comes to draw it. It also refuses all
    that is pasted for one letter that it does not take; here that one is left out.
    """

    def _process_entered_character(self, character: str) -> bool:
        letter = typed(character)
        return bool(letter) and bool(super()._process_entered_character(letter))

    def _do_paste(self) -> None:
        room = LONGEST if self.length_limit is None else self.length_limit
        pasted = str(clipboard_paste() or "")  # type: ignore[no-untyped-call]
        for letter in typed(pasted[:LONGEST])[:room]:
            self._process_entered_character(letter)
