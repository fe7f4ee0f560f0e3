"""Updates the translation catalogues with the texts of the code and the levels.

Run it as `python -m sandbox.cli.update_translations`. It needs Babel, which the extra `test`
installs.
"""

import builtins
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from io import BytesIO
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import pydantic_core

from sandbox import program
from sandbox.app.translatable_texts import has_words, shown_keys, words
from sandbox.app.words import language, level_translation
from sandbox.app.words.level_translation import words_of_name
from sandbox.model import level_catalog
from sandbox.model.annotated_field_search import prose
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.loading import load
from sandbox.optional_packages import needed_for

if TYPE_CHECKING:
    from babel.messages.catalog import Catalog

FOLDER = Path("sandbox") / "app"
"""The folder of the window, within a checkout."""

UNSAID = frozenset({"cli", "reporting"})
"""The packages whose messages never appear in the window."""

KEYWORDS = {
    "say": None,
    "later": None,
    "plural": (1, 2),
    "say_in": ((1, "c"), 2),
    "Message": None,
    "Fault": (2,),
    "refuse": (2,),
}
"""The functions that take a message, with the positions of the message arguments."""

_ERROR = re.compile(r"\b([A-Z]\w+Error)\(\s*\"[^\"]")
"""The call of an error with a text: the project's own take a message."""


def main() -> int:
    """Write the catalogues, print their paths, and return the exit status."""
    return generate(_write)


def _write() -> Iterator[Path]:
    with needed_for("To write the catalogues", "test"):
        from babel.messages.mofile import write_mo
        from babel.messages.pofile import write_po

    translations = [name for name in language.NAMES if name != language.ENGLISH]
    for domain, name in product(language.DOMAINS, translations):
        path = level_catalog.sources() / path_of(domain, name)
        translated = merged(path, name, SAID[domain]())
        edited, compiled = BytesIO(), BytesIO()
        write_po(edited, translated, width=100, include_lineno=False, ignore_obsolete=True)
        write_mo(compiled, translated)
        for place, content in ((path, edited), (path.with_suffix(".mo"), compiled)):
            write_atomically(place, content.getvalue())
            yield place


def path_of(domain: language.Domain, name: str) -> Path:
    """Return the path of the editable catalogue, within the project's sources."""
    languages = FOLDER / "languages"
    return (languages if domain == "window" else languages / domain) / f"{name}.po"


def of_the_window() -> "Catalog":
    """Return all English texts of the window, with the modules that contain them."""
    from babel.messages.catalog import Catalog
    from babel.messages.extract import extract

    found, root = Catalog(), level_catalog.sources()
    for path in said_in(root / "sandbox"):
        place = path.relative_to(root).as_posix()
        named = set(_ERROR.findall(path.read_text("utf-8")))
        keywords = KEYWORDS | dict.fromkeys(named.difference(dir(builtins), dir(pydantic_core)))
        with path.open("rb") as file:
            for line, message, _, context in extract("python", file, keywords):
                if any(map(has_words, (message,) if isinstance(message, str) else message)):
                    found.add(message, locations=[(place, line)], context=context)
    declared = [((FOLDER / "translatable_texts.py").as_posix(), 1)]
    for word in words():
        if word not in found:
            found.add(word, locations=declared)
    for key in shown_keys():
        found.add(key, locations=declared, context="key")
    return found


def said_in(sandbox: Path) -> list[Path]:
    """Return the modules whose messages appear in the window."""
    every = (path.relative_to(sandbox) for path in sandbox.rglob("*.py"))
    return [sandbox / path for path in sorted(every) if path.parts[0] not in UNSAID]


def of_the_levels() -> "Catalog":
    """Return all English texts of the levels, with their files: prose, and the words of names."""
    from babel.messages.catalog import Catalog

    found = Catalog()
    for name in level_catalog.names():
        path = level_catalog.root() / f"{name}.json"
        level = load(path)
        references = [(path.relative_to(level_catalog.root().parent).as_posix(), 1)]
        for _, text in prose(level):
            found.add(text, locations=references)
        for part in filter(has_words, map(words_of_name, (*level.bodies, *level.joints))):
            found.add(part, locations=references, context=level_translation.NAME)
    return found


SAID: Mapping[language.Domain, Callable[[], "Catalog"]] = {
    "window": of_the_window,
    "levels": of_the_levels,
}
"""The function that collects the English texts of each domain."""


def merged(path: Path, name: str, template: "Catalog") -> "Catalog":
    """Return a catalogue with all messages of a template, and their existing translations.

    A new message that resembles another one gets its translation, marked as `fuzzy`.
    """
    from babel.messages.catalog import Catalog
    from babel.messages.pofile import read_po

    head = f"# What the sandbox says, in the language {name}; make texts brings it up to date."
    translated = Catalog(locale=name, header_comment=head, project="mechanics-sandbox", fuzzy=False)
    if path.exists():
        with path.open("rb") as file:
            translated = read_po(file, locale=name)
    translated.update(template, update_creation_date=False)
    for message in translated:
        message.flags.discard("python-format")  # a per cent sign is no placeholder
    return translated


if __name__ == "__main__":
    with program.started():
        sys.exit(main())
