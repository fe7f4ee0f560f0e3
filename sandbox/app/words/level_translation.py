"""Translates the texts of the project's levels into the language of the window.

Other levels stay in the language of their authors. So does a level of the project once any of its
texts is changed: otherwise only a part of it would be translated.
"""

from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path

from sandbox.app.words import language
from sandbox.model import level_catalog
from sandbox.model.annotated_field_search import prose
from sandbox.model.level import Check, Level

Say = Callable[[str], str]
"""Translates a text of a level."""

NAME = "name"
"""The context of the names of bodies and joints in the catalogues of the levels."""


def of(level: Level) -> Say:
    """Return the function that translates the texts of a level into the current language."""
    return shown((text for _, text in prose(level)), level.source)


def title_of_level(level: Level) -> str:
    """Return the title of a level, translated into the current language."""
    return of(level)(level.title)


def shown(words: Iterable[str], source: str) -> Say:
    """Return the function that translates texts of a level's file into the current language."""
    if not _is_shipped(source):
        return str
    catalogue = language.catalogue(language.used(), "levels")
    try:
        translated = {text: catalogue.gettext(text) for text in words if text}
    except LookupError:
        return str
    return lambda text: translated.get(text, text)


@lru_cache(maxsize=512)
def _is_shipped(source: str) -> bool:
    """Whether a file is one of the project's levels."""
    return Path(source).is_relative_to(level_catalog.root())


def words_of_name(name: str) -> str:
    """Return the words of the name of a body or joint: rear axle of rear_axle2."""
    return name.rstrip("0123456789_").replace("_", " ").strip()


@lru_cache(maxsize=4096)
def name_in(used: language.Name, name: str) -> str:
    """Return the name of a body or joint as it is read in a language: Hinterachse 2.

    Words that name a part of a level of the project are translated, whatever level uses them: the
    parts that are drawn with the mouse are named by such words, too.
    """
    words = words_of_name(name)
    number = name[len(name.rstrip("0123456789_")) :].replace("_", " ").strip()
    translated = language.catalogue(used, "levels").pgettext(NAME, words) if words else ""
    return f"{translated} {number}".strip()


def title(check: Check, say: Say) -> str:
    """Return the title of a check, translated by `say`."""
    return say(check.label) or check.quantity
