"""The catalogues of the window's languages: complete, true to the code, and compiled."""

import ast
import re
import tomllib
from collections import Counter
from collections.abc import Iterator
from functools import cache
from gettext import GNUTranslations
from io import BytesIO
from itertools import product
from pathlib import Path
from string import Formatter

import pytest
from babel.messages.catalog import Catalog, Message
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po

from sandbox.app import translatable_texts
from sandbox.app.words import language
from sandbox.cli import update_translations
from sandbox.model import ledger_accounts, level_catalog
from sandbox.model.loading import load

TRANSLATED = [name for name in language.NAMES if name != language.ENGLISH]
EACH = pytest.mark.parametrize(
    ("domain", "name"), list(product(language.DOMAINS, TRANSLATED)), ids=str
)
"""Every catalogue."""


@cache
def template(domain: language.Domain) -> Catalog:
    """Return the English messages of all catalogues of a domain."""
    return update_translations.SAID[domain]()


def of(domain: language.Domain, name: str) -> Catalog:
    """Return the catalogue of a language, as people edit it."""
    with (level_catalog.sources() / update_translations.path_of(domain, name)).open("rb") as file:
        return read_po(file, locale=name)


def signs(text: str) -> Counter[str]:
    """Count the numbers of a text, and the signs of its formulas and units."""
    numbers = re.findall(r"\d+(?:\.\d+)?", re.sub(r"(?<=\d)[ ,](?=\d{3}\b)", "", text))
    letters = (sign for sign in text if not (sign.isascii() or sign in "ÄÖÜäöüß„“–…’"))
    return Counter([*numbers, *letters, *re.findall(r"[=+*/^%°()]", text)])


def messages(found: Catalog) -> Iterator[Message]:
    """Yield the messages of a catalogue without its head."""
    return (message for message in found if message.id)


def forms(text: str | list[str] | tuple[str, ...] | None) -> tuple[str, ...]:
    """Return the forms of a message, or of its translation: one, or one for each number."""
    return (text or "",) if text is None or isinstance(text, str) else tuple(text)


def test_no_error_is_made_of_a_text_that_is_put_together() -> None:
    """Only a literal can be looked up. Ruff rejects f-strings in the errors that it knows."""
    lint = tomllib.loads((level_catalog.sources() / "pyproject.toml").read_text("utf-8"))["tool"][
        "ruff"
    ]
    known = lint["lint"]["flake8-gettext"]["function-names"]
    for path in update_translations.said_in(level_catalog.sources() / "sandbox"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef) and "SandboxError" in map(ast.unparse, node.bases):
                own = any(
                    isinstance(p, ast.FunctionDef) and p.name == "__init__" for p in node.body
                )
                assert own or node.name in (*known, "IndexFault", "SimulationError"), node.name
            if isinstance(node, ast.Call) and node.args and ast.unparse(node.func) in known:
                assert not isinstance(node.args[0], ast.BinOp), f"{path}:{node.lineno}"
                assert not ast.unparse(node.args[0]).startswith(("str(", "repr(")), path


def places(text: str) -> set[tuple[str | None, str | None]]:
    """Return the places of values in a text: their names, and how they are written."""
    return {(name, written) for _, name, written, _ in Formatter().parse(text) if name is not None}


@pytest.mark.sweep
@EACH
def test_every_message_is_translated_and_none_is_left_of_what_is_gone(
    domain: language.Domain, name: str
) -> None:
    translated = of(domain, name)
    wanted = {(message.context, forms(message.id)[0]) for message in messages(template(domain))}
    found = {
        (message.context, forms(message.id)[0])
        for message in messages(translated)
        if all(forms(message.string)) and not message.fuzzy
    }

    assert not wanted - found, f"run `make texts`, then translate these: {domain}, {name}.po"
    assert not found - wanted, "run `make texts`: nobody says these any more"


@EACH
def test_every_message_in_a_catalogue_has_a_translation_that_was_confirmed(
    domain: language.Domain, name: str
) -> None:
    """`make texts` adds messages without one, or with a guess that is marked `fuzzy`."""
    missing = [
        forms(message.id)[0]
        for message in messages(of(domain, name))
        if message.fuzzy or not all(forms(message.string))
    ]

    assert not missing, f"translate these, and remove the marks 'fuzzy': {domain}, {name}.po"


@EACH
def test_a_translation_has_the_places_of_its_message(domain: language.Domain, name: str) -> None:
    for message in messages(of(domain, name)):
        for form in forms(message.string):
            assert places(form) == places(forms(message.id)[-1]), form


@pytest.mark.parametrize("name", TRANSLATED)
def test_what_a_level_says_keeps_its_numbers_and_formulas_in_translation(name: str) -> None:
    """1,000 may become 1000 or 1 000: elsewhere a comma is a decimal point."""
    for message in messages(of("levels", name)):
        text, form = forms(message.id)[0], forms(message.string)[0]
        assert signs(form) == signs(text), f"translate in levels, {name}.po: {text!r}, not {form!r}"


@EACH
def test_spaces_at_the_ends_of_a_message_are_there_in_its_translation(
    domain: language.Domain, name: str
) -> None:
    for message in messages(of(domain, name)):
        text, form = forms(message.id)[0], forms(message.string)[0]
        ends = [len(each) - len(each.lstrip()) for each in (text, form)]
        assert ends[0] == ends[1], form


@pytest.mark.parametrize("name", TRANSLATED)
def test_a_message_has_as_many_forms_as_its_language_has_for_numbers(name: str) -> None:
    translated = of("window", name)
    several = [message for message in messages(translated) if message.pluralizable]

    assert several
    assert {len(forms(message.string)) for message in several} == {translated.num_plurals}


@EACH
def test_what_the_window_reads_is_what_people_edit(
    domain: language.Domain, name: language.Name
) -> None:
    compiled = BytesIO()
    write_mo(compiled, of(domain, name))
    compiled.seek(0)
    used = language.catalogue(name, domain)
    assert isinstance(used, GNUTranslations)
    every = used, GNUTranslations(compiled)
    said, edited = (dict(each._catalog) for each in every)  # type: ignore[attr-defined]
    head = said.pop(""), edited.pop("")

    assert all(head)
    assert said == edited, "run `make texts`"


def test_a_language_that_is_new_begins_with_all_messages_and_no_translation(
    tmp_path: Path,
) -> None:
    new = update_translations.merged(tmp_path / "fr.po", "fr", template("window"))

    assert {message.id for message in new} == {message.id for message in template("window")}
    assert not any(any(forms(message.string)) for message in messages(new))


@pytest.mark.sweep
def test_every_account_of_every_level_is_a_word_that_is_declared() -> None:
    """The accounts of joints and effects are found, and so are the ledger's own."""
    words = set(translatable_texts.words())
    for name in level_catalog.names():
        level = load(level_catalog.root() / f"{name}.json")
        every = (
            ledger_accounts.potentials,
            ledger_accounts.works,
            ledger_accounts.losses,
            ledger_accounts.external_accounts,
        )
        booked = {account for kind in every for account in kind(level)}
        assert booked <= words, name


def test_a_key_is_a_message_with_a_context_of_its_own() -> None:
    """In German the key Delete has another name than the action."""
    assert template("window").get("Delete", context="key") is not None
    key, act = (of("window", "de").get("Delete", context=context) for context in ("key", None))
    assert key is not None
    assert act is not None
    assert key.string != act.string
