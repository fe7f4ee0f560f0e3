"""Translates the texts of the window, which the code contains in English.

A translation is a gettext catalogue in `languages`: `de.po` for editing, and `de.mo`, which is
compiled from it. The texts of the project's levels have their own catalogues, in
`languages/levels`. See `docs/how-to/translate-the-window.md`.
"""

import os
from collections.abc import Mapping
from functools import cache
from gettext import GNUTranslations, NullTranslations
from importlib.resources import files
from importlib.resources.abc import Traversable
from string import Formatter
from typing import Literal, get_args

from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message

Name = Literal["en", "de"]
"""The code of a language, and the name of its catalogue."""
NAMES: tuple[Name, ...] = get_args(Name)
"""All languages, in the order of the menu."""
TITLES: Mapping[Name, str] = {"en": "English", "de": "Deutsch"}
"""The name of each language in that language."""
ENGLISH: Name = "en"
"""The language of the source code, which needs no catalogue, and the default."""

Domain = Literal["window", "levels"]
"""The catalogues: texts of the window, and texts of the levels."""
DOMAINS: tuple[Domain, ...] = get_args(Domain)

_VARIABLES = ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")
"""The environment variables that set the language; the first that is set counts."""

_used = ENGLISH


def use(name: Name) -> None:
    """Switch to a language; texts that are already made do not change."""
    global _used
    _used = name


def used() -> Name:
    """Return the code of the current language."""
    return _used


def system_language(environment: Mapping[str, str] = os.environ) -> Name:
    """Return the first of the system's languages that is available, else English."""
    setting = next(filter(None, (environment.get(name) for name in _VARIABLES)), "")
    languages = (part.replace("-", "_").partition("_")[0].lower() for part in setting.split(":"))
    return next((name for part in languages for name in NAMES if name == part), ENGLISH)


def say(message: str, **values: object) -> str:
    """Return a message in the current language, with a value for each `{name}` in braces.

    A `Message`, like that of an error, contains its values. Messages and errors among the values
    are translated, too.
    """
    template = message
    if isinstance(message, Message):
        template, values = message.template, dict(message.values)
    translated = catalogue(_used).gettext(template) if template else ""
    if not values:
        return translated
    values = {name: _formatted(value) for name, value in values.items()}
    if _used != ENGLISH and ":," in translated:
        return _GROUPED.vformat(translated, (), values)
    return translated.format(**values)


class _Grouped(Formatter):
    """Separates the thousands of a number by a space, since a comma may be a decimal one."""

    def format_field(self, value: object, format_spec: str) -> str:
        text: str = super().format_field(value, format_spec)
        return text.replace(",", "\N{NO-BREAK SPACE}") if "," in format_spec else text


_GROUPED = _Grouped()


def _formatted(value: object) -> object:
    if isinstance(value, SandboxError):
        value = value.message
    return say(value) if isinstance(value, Message) else value


def say_in(context: str, message: str) -> str:
    """Translate a message whose meaning depends on a context, which translators see."""
    return catalogue(_used).pgettext(context, message)


def plural(one: str, more: str, count: int, **values: object) -> str:
    """Return the form of a message for a count, which is put in for `{count}`."""
    return catalogue(_used).ngettext(one, more, count).format(count=count, **values)


def later(message: str) -> str:
    """Mark a message that `say` translates later: a constant, or an entry of a table."""
    return message


def folder(domain: Domain) -> Traversable:
    """Return the folder with the catalogues of a domain."""
    languages = files("sandbox.app") / "languages"
    return languages if domain == "window" else languages / domain


class _Unknown(NullTranslations):
    """The fallback of a catalogue, which raises for missing messages."""

    def gettext(self, message: str) -> str:
        raise LookupError(message)


@cache
def catalogue(name: Name, domain: Domain = "window") -> NullTranslations:
    """Return the catalogue of a language; that of English returns its input.

    A catalogue of the levels raises a `LookupError` for a missing message; that is how edited
    levels are recognised.
    """
    if name == ENGLISH:
        return NullTranslations()
    with (folder(domain) / f"{name}.mo").open("rb") as file:
        found = GNUTranslations(file)
    if domain == "levels":
        found.add_fallback(_Unknown())
    return found
