"""Texts of the levels that come with the project are translated, and no others."""

import json
from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest

from sandbox.app.drawing.text import Pen
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.words import language, level_translation
from sandbox.app.words.formatting import name_in_words
from sandbox.model import level_catalog
from sandbox.model.annotated_field_search import prose
from sandbox.model.loading import load
from tests.app.person import Person
from tests.app.scenes import falling

FALL = level_catalog.root() / "kinematics" / "free-fall.json"


@pytest.fixture
def german() -> Iterator[None]:
    language.use("de")
    yield
    language.use(language.ENGLISH)


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Every text drawn by a window that is opened later."""
    found: set[str] = set()
    write = Pen._write

    def noted(pen: Pen, text: str, *arguments: object, **named: object) -> pygame.Surface:
        found.add(text)
        return write(pen, text, *arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(Pen, "_write", noted)
    return found


def speak(person: Person, name: language.Name) -> None:
    person.window.comfort.choose(language=name)
    person.wait(0.1)


@pytest.mark.usefixtures("german")
def test_what_a_level_says_that_comes_with_the_project_is_translated() -> None:
    level = load(FALL)
    words = level_translation.of(level)

    assert words(level.title) == "Freier Fall"
    assert level_translation.title(level.checks[0], words) == "nach einer Sekunde gefallen: g/2"


@pytest.mark.usefixtures("german")
def test_a_copy_of_it_stays_in_the_language_of_its_author(tmp_path: Path) -> None:
    copy = tmp_path / FALL.name
    copy.write_bytes(FALL.read_bytes())
    level = load(copy)

    assert level_translation.of(level)(level.title) == "Free fall"


@pytest.mark.usefixtures("german")
def test_where_some_words_of_it_are_edited_none_is_translated() -> None:
    level = load(FALL).model_copy(update={"title": "My fall"})
    words = level_translation.of(level)

    assert [words(text) for _, text in prose(level)] == [text for _, text in prose(level)]


@pytest.mark.usefixtures("german")
def test_where_its_numbers_are_edited_its_words_stay_translated() -> None:
    level = load(FALL)
    other = level.model_copy(update={"checks": level.checks[:1]})

    assert level_translation.of(other)(level.title) == "Freier Fall"


def test_in_english_a_level_says_what_its_file_says() -> None:
    level = load(FALL)

    assert level_translation.of(level)(level.title) == "Free fall"


def test_the_page_of_a_level_says_it_in_german_after_a_switch_while_it_runs(
    drawn: set[str], person: Person
) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.1)
    assert {"Atwood machine", "tension"} <= drawn
    world = person.session.world
    drawn.clear()
    speak(person, "de")

    assert person.session.world is world
    assert {"Atwoodsche Fallmaschine", "linke Masse", "Seilkraft"} <= drawn
    assert not {"Atwood machine", "left mass", "tension"} & drawn
    assert "Atwoodsche Fallmaschine" in pygame.display.get_caption()[0]


def test_what_was_reached_on_the_way_is_written_in_the_language_of_now(
    drawn: set[str], person: Person
) -> None:
    person.window.open_level("kinematics/projectile")
    for _ in range(130):
        person.session.step()
    person.wait()
    assert "apex 15.9 m" in drawn
    speak(person, "de")

    assert "Scheitelhöhe 15.9 m" in drawn


def test_words_on_the_stage_are_written_in_the_language_of_now(
    drawn: set[str], person: Person
) -> None:
    person.window.open_level("machines/two-carts")
    person.wait()
    assert {"gentle", "steep"} <= drawn
    speak(person, "de")

    assert {"sanft", "steil"} <= drawn


def test_the_cards_of_the_home_page_are_german_after_a_switch(
    drawn: set[str], person: Person
) -> None:
    person.press(pygame.K_F2)
    person.wait(0.1)
    assert "Free fall" in drawn
    drawn.clear()
    speak(person, "de")

    assert {"Freier Fall", "Kinematik"} <= drawn
    assert "Free fall" not in drawn
    speak(person, "en")
    assert person.window.panels.home.grid.cards[1][0].title == "Free fall"


def test_a_body_is_named_in_german_on_the_stage_and_where_its_forces_are_listed(
    drawn: set[str], person: Person
) -> None:
    speak(person, "de")
    drawn.clear()
    person.window.open_level("newton/incline")
    person.session.step()
    person.press(pygame.K_j, "j")
    x, y = person.session.world.snapshot.position[0].tolist()
    person.click(person.on_screen((x, y)))
    person.wait(0.1)

    assert {"Klotz", "Kräfte auf Klotz"} <= drawn
    assert "block" not in drawn


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("rear_axle2", "Hinterachse 2"),
        ("box1_3", "Kiste 1 3"),
        ("a1", "a 1"),
        ("my_own", "my own"),
    ],
)
def test_names_are_read_in_german_if_levels_of_the_project_use_their_words(
    name: str, read: str
) -> None:
    assert name_in_words(name) == read


@pytest.mark.parametrize("typed", ["klotz accel", "block.accel"])
def test_a_quantity_is_found_by_the_name_on_the_stage_and_by_its_own(
    person: Person, typed: str
) -> None:
    speak(person, "de")
    person.window.open_level("newton/incline")
    person.press(pygame.K_d, "d")
    person.click(person.page(GraphPage).sought.rect)
    person.type(typed)

    listed = [item["text"] for item in person.page(GraphPage).up.item_list]
    assert listed
    assert all(n.startswith("block.") and "acceleration" in n for n in listed)


@pytest.mark.parametrize("typed", ["freier", "free fall", "losgelassen"])
def test_a_level_is_found_by_german_words_and_by_those_of_its_author(
    person: Person, typed: str
) -> None:
    speak(person, "de")
    person.press(pygame.K_SLASH, "/")
    person.type(typed)

    assert person.listed.matching_levels[0].title == "Freier Fall"


def test_in_english_no_german_word_finds_a_level(person: Person) -> None:
    person.press(pygame.K_SLASH, "/")
    person.type("freier")

    assert person.listed.matching_levels == []


def test_stars_stay_with_a_challenge_in_whichever_language(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are kept by the title in its file."""
    asked = level_catalog.root() / "challenges" / "stop-dead.json"
    title = json.loads(asked.read_text("utf-8"))["title"]
    person.window.files.read_again(asked)
    monkeypatch.setattr(
        "sandbox.app.files.challenge_stars.ChallengeStars.stars", lambda _, told: told == title
    )
    speak(person, "de")
    button = person.listed.button(asked)

    assert "•" in button.text
    assert "Auf der Stelle" in button.text


def test_a_level_of_ones_own_says_what_its_author_wrote(
    drawn: set[str], person: Person, tmp_path: Path
) -> None:
    """Even if a level of the catalog has the same text in German."""
    speak(person, "de")
    person.open(tmp_path, falling(title="Free fall"))

    assert {"Free fall", "gravity"} <= drawn
    assert "Schwerkraft" not in drawn
