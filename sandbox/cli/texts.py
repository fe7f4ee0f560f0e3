"""The catalogues of the window's languages, brought up to date with what the code says.

`python -m sandbox.cli.texts` does so. It needs Babel, which the extra `test` brings.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from babel.messages.catalog import Catalog
from babel.messages.extract import extract
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from sandbox.app import language
from sandbox.app.declared import shown_keys, words
from sandbox.model import catalog
from sandbox.model.generating import generate

FOLDER = Path("sandbox") / "app"
"""In the project's sources: what speaks to whom sits before the window."""

KEYWORDS = {"say": None, "later": None, "plural": (1, 2), "say_in": ((1, "c"), 2)}
"""The functions of `sandbox.app.language`, and which of their arguments are messages."""


def main() -> int:
    """Write the catalogues, say where, and return the exit status."""
    return generate(_write)


def _write() -> Iterator[Path]:
    folder, template = catalog.sources() / FOLDER / "languages", messages()
    for name in language.NAMES:
        if name == language.ENGLISH:
            continue
        path = folder / f"{name}.po"
        translated = merged(path, name, template)
        with path.open("wb") as file:
            write_po(file, translated, width=100, include_lineno=False, ignore_obsolete=True)
        yield path
        with path.with_suffix(".mo").open("wb") as file:
            write_mo(file, translated)
        yield path.with_suffix(".mo")


def messages() -> Catalog:
    """Return all that the window says, in English, with the modules that say it."""
    found, root = Catalog(), catalog.sources()
    for path in sorted((root / FOLDER).rglob("*.py")):
        place = path.relative_to(root).as_posix()
        with path.open("rb") as file:
            for line, message, _, context in extract("python", file, KEYWORDS):
                found.add(message, locations=[(place, line)], context=context)
    declared = [((FOLDER / "declared.py").as_posix(), 1)]
    for word in words():
        if word not in found:
            found.add(word, locations=declared)
    for key in shown_keys():
        found.add(key, locations=declared, context="key")
    return found


def merged(path: Path, name: str, template: Catalog) -> Catalog:
    """Return a catalogue with all messages of a template, as far as they are translated there.

    One that resembles a message which is gone has that one's translation, marked as `fuzzy`.
    """
    head = f"# What the window of the sandbox says, in the language {name}."
    translated = Catalog(locale=name, header_comment=head, project="mechanics-sandbox", fuzzy=False)
    if path.exists():
        with path.open("rb") as file:
            translated = read_po(file, locale=name)
    translated.update(template, update_creation_date=False)
    for message in translated:
        message.flags.discard("python-format")  # a per cent sign is one, and no place for a value
    return translated


if __name__ == "__main__":
    sys.exit(main())
