"""A language in which every letter that is said through the catalogue is a capital.

What is shown in small letters was not said so: it is of the level, a unit, or forgotten.
"""

import re
from collections.abc import Iterator
from gettext import GNUTranslations, NullTranslations

import pygame
import pytest
from pygame_gui.elements import UIButton

from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.widgets.text_field import TextField
from sandbox.app.words import language
from tests.app.person import Person

WORD = re.compile(r"[a-zäöüß]{2,}")
PLACES = re.compile(r"(\{[^}]*\})")
UNITS = {"kg", "ms", "rad", "px", "deg", "mm", "cm", "km", "min", "mJ", "mN"}
NAMES = re.compile(r"\b[\w]+(\.\w+)+|\S*/\S*|\d\S*")
"""What is written as it stands in a file: quantities, paths and units of several parts, numbers."""


class Capitals(NullTranslations):
    """Says everything in capitals, and notes what no catalogue has.

    Attributes
    ----------
    strays
        The messages that are in no catalogue.
    """

    def __init__(self) -> None:
        super().__init__()
        german = language.catalogue("de")
        assert isinstance(german, GNUTranslations)
        keys = german._catalog  # type: ignore[attr-defined]
        self._known = {key if isinstance(key, str) else key[0] for key in keys}
        self.strays: set[str] = set()

    def gettext(self, message: str) -> str:
        self._look_up(message, message)
        return capitals(message)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        self._look_up(msgid1, msgid1)
        return capitals(msgid1 if n == 1 else msgid2)

    def pgettext(self, context: str, message: str) -> str:
        self._look_up(message, f"{context}\x04{message}")
        return capitals(message)

    def _look_up(self, message: str, key: str) -> None:
        if WORD.search(PLACES.sub("", message)) and key not in self._known:
            self.strays.add(message)


def capitals(message: str) -> str:
    """Return a message in capitals, with the places of its values as they are."""
    parts = PLACES.split(message)
    return "".join(part if part.startswith("{") else part.upper() for part in parts)


class Loud(NullTranslations):
    """Says everything in capitals, as if it were in the catalogue."""

    def gettext(self, message: str) -> str:
        return message.upper()


class Speech:
    """Hears all that a window writes.

    Attributes
    ----------
    capitals
        The language that it speaks.
    heard
        The texts that were drawn.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.capitals = Capitals()
        self.heard: set[str] = set()
        domains = {"window": self.capitals, "levels": Loud()}
        monkeypatch.setattr(language, "catalogue", lambda _, domain="window": domains[domain])
        write = Pen._write

        def noted(
            pen: Pen, text: str, size: int = 14, color: Color | None = None, bold: bool = False
        ) -> pygame.Surface:
            self.heard.add(text)
            return write(pen, text, size, color, bold)

        monkeypatch.setattr(Pen, "_write", noted)

    def look(self, person: Person) -> None:
        """Take in what is written on widgets, and what they say while the mouse rests on them."""
        manager = person.window.panels.manager
        for each in manager.get_sprite_group().sprites():
            self.heard.add(getattr(each, "tool_tip_text", "") or "")
            if isinstance(each, UIButton):
                listed = (
                    "_list" in each.most_specific_combined_id
                )  # names of quantities, or of files
                self.heard.add("" if listed else each.text)
            elif isinstance(each, TextField):
                self.heard.add(each.placeholder_text or "")

    def small(self, given: set[str]) -> Iterator[str]:
        """Yield what was not said in the language, but for words that are given by the level."""
        for text in sorted(self.heard):
            if text.startswith("pygame-gui."):
                continue  # it has catalogues of its own, and keys for its messages
            words = set(WORD.findall(NAMES.sub(" ", text)))
            if words - UNITS - given:
                yield text
