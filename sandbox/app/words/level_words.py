"""The texts of the levels that come with the project, in the language of the window.

A level that a person has written stays in the language of its author. So does one that comes with
the project, as soon as any of its words is changed: otherwise it would be translated by half.
"""

from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path

from sandbox.app.words import language
from sandbox.model import catalog
from sandbox.model.level import Check, Level
from sandbox.model.prose_fields import prose

Say = Callable[[str], str]
"""Translates a text of a level."""


def of(level: Level) -> Say:
    """Return what puts the words of a level as they are shown now."""
    return shown((text for _, text in prose(level)), level.source)


def shown(words: Iterable[str], source: str) -> Say:
    """Return what puts words of a level as they are shown now.

    Parameters
    ----------
    words
        All that are known of it.
    source
        The level's file.
    """
    if not _comes_along(source):
        return str
    known = language.catalogue(language.used(), "levels")
    try:
        said = {text: known.gettext(text) for text in words if text}
    except LookupError:
        return str
    return lambda text: said.get(text, text)


@lru_cache(maxsize=512)
def _comes_along(source: str) -> bool:
    """Whether a file is one of those that come with the project."""
    return Path(source).is_relative_to(catalog.root())


def title(check: Check, say: Say) -> str:
    """Name what is checked, as it is shown."""
    return say(check.label) or check.quantity
