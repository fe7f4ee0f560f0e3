"""The entry of a level in the list, read without loading the whole level."""

import json
from pathlib import Path
from typing import Any, NamedTuple

from sandbox.app.drawing.text import legible
from sandbox.app.words import level_translation
from sandbox.app.words.language import say
from sandbox.model import loading
from sandbox.model.errors import LevelError

LONGEST = 1000
"""The most characters of a text that are shown and searched."""


class Texts(NamedTuple):
    """The texts in a level's file."""

    title: str
    summary: str = ""
    reference: str = ""


class Entry(NamedTuple):
    """A level in the list."""

    path: Path
    """The file."""
    chapter: str
    """The chapter under which it is listed."""
    original: Texts
    """The texts of the file, in the language of its author."""
    title: str
    """The title in the current language."""
    summary: str
    """The summary in the current language."""
    words: str
    """The text that a search looks through, in lower case: as shown, and as in the file."""

    def in_current_language(self) -> "Entry":
        """Return the entry in the current language."""
        return _entry(self.path, self.chapter, self.original)


def entry(path: Path, chapter: str) -> Entry:
    """Return the entry of a file, even one that cannot be read."""
    try:
        data = json.loads(loading.read(path))
        title, summary, reference = (_text(data, name) for name in Texts._fields)
        texts = Texts(title or path.stem, summary, reference)
    except (LevelError, ValueError, AttributeError, RecursionError):
        texts = Texts(path.stem)  # the reason is shown when the file is opened
    return _entry(path, chapter, texts)


def _text(data: dict[str, Any], name: str) -> str:
    """Return a text of a level's file; empty if there is none."""
    found = data.get(name)
    return legible(found[:LONGEST]).strip() if isinstance(found, str) else ""


def _entry(path: Path, chapter: str, texts: Texts) -> Entry:
    shown = Texts(*map(level_translation.shown(texts, str(path)), texts))
    called = chapter, say(chapter.capitalize()), path.stem.replace("-", " ")
    words = " ".join(dict.fromkeys((*called, *shown, *texts))).casefold()
    return Entry(path, chapter, texts, shown.title, shown.summary, words)
