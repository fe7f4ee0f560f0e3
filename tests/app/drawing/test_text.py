"""Whatever a person types or pastes, and whatever another author's level says, can be drawn."""

import json
import sys
from pathlib import Path
from time import process_time

import pygame
import pytest

from sandbox.app.drawing import text, theme
from sandbox.app.drawing.text import Pen, legible, typed
from sandbox.app.widgets.text_field import LONGEST
from tests.app.person import Person
from tests.model.levels import bare
from tests.sample import thinned

UNSEEN = [chr(c) for c in (0x200B, 0x202E, 0xAD, 0xFE0F, 0x301, 0, 0x1B, 0xD800, 0x10FFFE, 10)]
"""What has no width: spaces, marks of direction, accents alone, half characters, none at all."""


@pytest.fixture
def player(person: Person) -> Person:
    person.window.open_level("newton/atwood")
    person.wait()
    return person


def enter(player: Person, text: str) -> None:
    """Type a text into the field that has the keyboard, as an input method would."""
    pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=text))
    player.wait(0.05)


def paste(player: Person, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sandbox.app.widgets.text_field.clipboard_paste", lambda: text)
    player.press(pygame.K_v, mod=pygame.KMOD_CTRL)


def test_a_path_that_is_wider_than_a_line_is_cut_between_its_folders(pen: Pen) -> None:
    path = "/home/somebody/Documents/Mechanics sandbox"

    lines = pen.wrap(f"Files go to {path}", pen.font(14, bold=False).size(path[:30])[0])

    assert lines == ["Files go to", "/home/somebody/Documents/", "Mechanics sandbox"]


def test_a_word_without_a_sign_is_cut_where_the_line_ends(pen: Pen) -> None:
    width = pen.font(14, bold=False).size("m" * 10)[0]

    assert pen.wrap("/" + "m" * 15, width) == ["/" + "m" * 9, "m" * 6]


@pytest.mark.parametrize("letter", thinned(UNSEEN, 4), ids=ascii)
def test_a_letter_without_width_is_not_taken_into_the_field_that_finds_levels(
    player: Person, letter: str
) -> None:
    player.press(pygame.K_SLASH, "/")
    enter(player, letter)
    enter(player, "a")
    enter(player, f"{letter}b")

    assert player.listed.search_text.replace(" ", "") == "ab"


@pytest.mark.parametrize("letter", thinned(UNSEEN, 4), ids=ascii)
def test_what_is_pasted_is_taken_but_for_what_cannot_be_drawn(
    player: Person, letter: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    player.press(pygame.K_SLASH, "/")
    paste(player, f"{letter}hard{letter}", monkeypatch)

    assert player.listed.search_text.replace(" ", "") == "hard"


def test_a_book_that_is_pasted_is_cut(player: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    player.press(pygame.K_SLASH, "/")
    paste(player, "a word and another " * 100_000, monkeypatch)

    assert len(player.listed.search_text) == LONGEST


def test_an_empty_clipboard_changes_nothing(
    player: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    player.press(pygame.K_SLASH, "/")
    paste(player, "", monkeypatch)

    assert player.listed.search_text == ""


@pytest.mark.parametrize("letter", thinned(UNSEEN, 4), ids=ascii)
def test_a_number_is_typed_past_what_cannot_be_drawn(
    player: Person, letter: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    player.press(pygame.K_TAB)
    paste(player, f"2{letter}.5 kg", monkeypatch)
    player.press(pygame.K_RETURN)

    assert 2.5 in player.session.values.values()


@pytest.mark.parametrize(
    "text", ["\u200b", "\u202e\u202dx", "\x00", "a\tb\nc", "x\u0302", "<b>&amp;"]
)
def test_a_level_may_say_anything_and_is_shown(person: Person, text: str, tmp_path: Path) -> None:
    data = bare()
    data |= {"title": text, "summary": text, "reference": text}
    data["parameters"]["m"] |= {"label": text, "unit": text}
    data["checks"][0]["label"] = text

    person.open(tmp_path, json.dumps(data))
    person.wait(0.1)

    assert person.session.level.title == text


def test_a_file_whose_title_is_half_a_character_is_listed(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, '{"title": "\\ud800"}')

    assert person.window.session is None


@pytest.mark.sweep
def test_every_character_can_be_written() -> None:
    pygame.font.init()
    pen = Pen()
    for first in range(0, sys.maxunicode, 4096):
        letters = [chr(code) for code in range(first, first + 4096, 61)]
        pen._write("".join(letters))
        for letter in letters[::4]:
            pen._write(letter)
            pen.shorten(letter, 1)
            pen.wrap(letter, 1)


def test_letters_keep_their_accents() -> None:
    assert legible("e\u0301x\u0302") == "éx\u0302"
    assert typed("e\u0301") == "é"


def test_a_sign_that_the_font_lacks_is_drawn_after_a_change_of_theme(pen: Pen) -> None:
    """Its pixels were compared with a box in the colour of the theme before."""
    text._lacks.cache_clear()
    text._box.cache_clear()
    before = theme.used()
    try:
        pen.write("\u2192")
        theme.use("light" if before == "dark" else "dark")
        assert text._lacks("\u2713")
    finally:
        theme.use(before)


def test_as_much_of_a_text_is_shown_as_fits(pen: Pen) -> None:
    text = "a text that is too long for where it is to stand"
    font = pen.font(14, False)

    for width in range(20, 300, 7):
        shown = pen.shorten(text, width)
        one_more = text[: len(shown)].rstrip()
        assert text.startswith(shown.removesuffix("…"))
        assert font.size(shown)[0] <= width
        assert shown.removesuffix("…") == one_more or font.size(f"{one_more}…")[0] > width


def test_of_a_text_without_end_the_beginning_is_shown_at_once(pen: Pen) -> None:
    """Letter by letter, a text of this length took minutes."""
    begun = process_time()

    assert pen.shorten("ab" * 50_000, 100).startswith("abab")
    assert process_time() - begun < 1


@pytest.mark.parametrize(
    ("word", "lines"),
    [
        ("Anfangsgeschwindigkeit", ["Anfangsgeschwindig-", "keit"]),
        ("Winkelbeschleunigung", ["Winkelbeschleuni-", "gung"]),
        ("Abwurfgeschwindigkeit,", ["Abwurfgeschwin-", "digkeit,"]),
        ("deceleration", ["decelera-", "tion"]),
    ],
)
def test_a_word_that_is_too_long_is_broken_between_syllables(
    pen: Pen, word: str, lines: list[str]
) -> None:
    """Labels of parameters read Anfangsgeschwindigkei, and a t below it."""
    width = max(pen.font(12, False).size(lines[0])[0], pen.font(12, False).size(lines[1])[0])

    assert pen.wrap(word, width, 12) == lines


def test_a_word_without_syllables_is_broken_anywhere(pen: Pen) -> None:
    assert "".join(pen.wrap("x" * 60, 100, 12)) == "x" * 60
