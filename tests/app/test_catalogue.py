"""The catalogues of the window's languages: complete, true to the code, and compiled."""

from collections.abc import Iterator
from gettext import GNUTranslations
from io import BytesIO
from pathlib import Path
from string import Formatter

import pytest
from babel.messages.catalog import Catalog, Message
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po

from sandbox.app import declared, language
from sandbox.cli import texts
from sandbox.model import accounts, catalog
from sandbox.model.loading import load

TRANSLATED = [name for name in language.NAMES if name != language.ENGLISH]
FOLDER = Path(str(language.FOLDER))


@pytest.fixture(scope="module")
def template() -> Catalog:
    """All that the window says, in English."""
    return texts.messages()


def of(name: str) -> Catalog:
    """Return the catalogue of a language, as people edit it."""
    with (FOLDER / f"{name}.po").open("rb") as file:
        return read_po(file, locale=name)


def messages(found: Catalog) -> Iterator[Message]:
    """Yield the messages of a catalogue without its head."""
    return (message for message in found if message.id)


def forms(text: str | list[str] | tuple[str, ...] | None) -> tuple[str, ...]:
    """Return the forms of a message, or of its translation: one, or one for each number."""
    return (text or "",) if text is None or isinstance(text, str) else tuple(text)


def places(text: str) -> set[tuple[str | None, str | None]]:
    """Return the places of values in a text: their names, and how they are written."""
    return {(name, written) for _, name, written, _ in Formatter().parse(text) if name is not None}


@pytest.mark.parametrize("name", TRANSLATED)
def test_every_message_is_translated_and_none_is_left_of_what_is_gone(
    template: Catalog, name: str
) -> None:
    translated = of(name)
    wanted = {(message.context, forms(message.id)[0]) for message in messages(template)}
    found = {
        (message.context, forms(message.id)[0])
        for message in messages(translated)
        if all(forms(message.string)) and not message.fuzzy
    }

    assert not wanted - found, f"run `make texts`, then translate these in {name}.po"
    assert not found - wanted, "run `make texts`: nobody says these any more"


@pytest.mark.parametrize("name", TRANSLATED)
def test_a_translation_has_the_places_of_its_message(name: str) -> None:
    for message in messages(of(name)):
        for form in forms(message.string):
            assert places(form) == places(forms(message.id)[-1]), form


@pytest.mark.parametrize("name", TRANSLATED)
def test_spaces_at_the_ends_of_a_message_are_there_in_its_translation(name: str) -> None:
    for message in messages(of(name)):
        text, form = forms(message.id)[0], forms(message.string)[0]
        ends = [len(each) - len(each.lstrip()) for each in (text, form)]
        assert ends[0] == ends[1], form


@pytest.mark.parametrize("name", TRANSLATED)
def test_a_message_has_as_many_forms_as_its_language_has_for_numbers(name: str) -> None:
    translated = of(name)
    several = [message for message in messages(translated) if message.pluralizable]

    assert several
    assert {len(forms(message.string)) for message in several} == {translated.num_plurals}


@pytest.mark.parametrize("name", TRANSLATED)
def test_what_the_window_reads_is_what_people_edit(name: language.Name) -> None:
    compiled = BytesIO()
    write_mo(compiled, of(name))
    compiled.seek(0)
    used = language.catalogue(name)
    assert isinstance(used, GNUTranslations)
    every = used, GNUTranslations(compiled)
    said, edited = (dict(each._catalog) for each in every)  # type: ignore[attr-defined]
    head = said.pop(""), edited.pop("")

    assert all(head)
    assert said == edited, "run `make texts`"


def test_a_language_that_is_new_begins_with_all_messages_and_no_translation(
    template: Catalog, tmp_path: Path
) -> None:
    new = texts.merged(tmp_path / "fr.po", "fr", template)

    assert {message.id for message in new} == {message.id for message in template}
    assert not any(any(forms(message.string)) for message in messages(new))


def test_every_account_of_every_level_is_a_word_that_is_declared() -> None:
    """What a joint or an effect books is found; so is what the ledger books of its own."""
    words = set(declared.words())
    for name in catalog.names():
        level = load(catalog.root() / f"{name}.json")
        every = accounts.potentials, accounts.works, accounts.losses, accounts.outside
        booked = {account for kind in every for account in kind(level)}
        assert booked <= words, name


def test_a_key_is_a_message_with_a_context_of_its_own(template: Catalog) -> None:
    """Delete is a key, which has another name in German than what it does."""
    assert template.get("Delete", context="key") is not None
    key, act = (of("de").get("Delete", context=context) for context in ("key", None))
    assert key is not None
    assert act is not None
    assert key.string != act.string
