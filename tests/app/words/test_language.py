"""The window in other languages: chosen, kept, complete, and changed during a run."""

import ast
import json
import re
from collections.abc import Iterator, Mapping
from itertools import combinations
from pathlib import Path
from typing import Any, get_args, get_type_hints

import numpy as np
import pygame
import pytest

from sandbox import app
from sandbox.app.cards.energy import ledger
from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing.text import Pen
from sandbox.app.files import preferences, save_folder
from sandbox.app.pages.challenge.panel import ChallengePage
from sandbox.app.pages.effects.panel import EffectsPage
from sandbox.app.pages.page import Page
from sandbox.app.pages.predict.panel import PredictPage
from sandbox.app.pages.register import PAGES
from sandbox.app.pages.scheme_race.panel import RacePage
from sandbox.app.pages.settings.panel import SettingsPage
from sandbox.app.words import language
from sandbox.model import level_catalog
from sandbox.model.annotated_field_search import Words, prose
from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.energy.balance import Balance
from tests.app.building.builder import Builder
from tests.app.person import Person, until
from tests.app.scenes import falling
from tests.app.speech import Speech
from tests.sample import thinned

OWN_NAMES = {"nglish", "eutsch"}
"""What languages call themselves, but for the first letter."""


SHOWING = {
    "text", "heading", "label", "write", "outlined", "paragraph", "show_message", "_show_note",
    "_show_at_once",
    "Act", "Block", "Offer", "Choice", "Setting",
}  # fmt: skip
"""What draws or tells a text, or keeps one that is shown."""


@pytest.fixture
def few() -> int:
    """List no level, since titles stay as their authors wrote them."""
    return 0


@pytest.fixture
def speech(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Speech:
    """Everything that is written, in a window that speaks in capitals and names nothing."""
    monkeypatch.setattr(save_folder, "folder", lambda: Path("/"))
    monkeypatch.setattr(level_catalog, "root", lambda: tmp_path)
    return Speech(monkeypatch)


def shipped(**changes: object) -> str:
    """Return the falling ball with words in every field that may have some, and names in capitals.

    In a window that speaks in capitals it counts as one that comes with the project.
    """
    ball: dict[str, Any] = {"shape": {"type": "disc", "radius": 0.5}, "mass": 1, "position": [0, 5]}
    check = {"quantity": "B.speed", "formula": "10*t", "tolerance": 1e-9}
    landing = {"event": "landing", "body": "B", "height": 2}
    goal = {"quantity": "B.speed", "at": 0.5, "above": 1, "label": "it is fast"}
    told: dict[str, object] = {
        "title": "a fall", "summary": "it falls.", "reference": "chapter on falling",
        "parameters": {"G": {"value": 10, "min": 1, "max": 20, "unit": "m/s²", "label": "pull"}},
        "effects": {"gravity": {"acceleration": [0, "-G"]}},
        "bodies": {"B": ball, "C": {**ball, "position": [3, 5]}},
        "checks": [
            check,
            {**check, "label": "half way", "at": 0.5},
            {**check, "label": "landed", "at": landing},
        ],
        "challenge": {
            "task": "let it fall", "free": ["G"], "goals": [goal], "stars": [goal],
            "hints": ["heavier", "heavier still"], "solution": {"G": 9},
        },
        "view": {"labels": [{"text": "here", "at": [1, 1]}]},
        "ghosts": {},
    }  # fmt: skip
    return falling(**{**told, **changes})


def worded(hint: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:  # noqa: ANN401
    """Yield the fields of a type that have texts, by the fields that lead there."""
    if any(isinstance(mark, Words) for mark in getattr(hint, "__metadata__", ())):
        yield path
    elif isinstance(hint, type) and issubclass(hint, Model):
        for field, kind in get_type_hints(hint, include_extras=True).items():
            yield from worded(kind, (*path, field))
    else:
        for part in get_args(hint):
            yield from worded(part, path)


def turn_to(person: Person, page: str) -> None:
    found = next(each for each in PAGES if each.name == page)
    person.press(pygame.key.key_code(found.key), found.key)


def choose(person: Person, title: str) -> None:
    """Choose a language on the page of the settings, with the mouse."""
    turn_to(person, "settings")
    page = person.page(SettingsPage)
    person.click(page.button(title).rect)
    person.wait(0.1)


def heard(speech: Speech, person: Person) -> None:
    """Check that everything written so far was translated, and is in the catalogue."""
    speech.look(person)

    assert list(speech.small(OWN_NAMES)) == []
    assert not speech.capitals.strays, "run 'make texts' and translate these, or pass them to 'say'"


@pytest.mark.parametrize(
    ("environment", "name"),
    [
        ({}, "en"),
        ({"LANG": "C.UTF-8"}, "en"),
        ({"LANG": "de_AT.UTF-8"}, "de"),
        ({"LANG": "de_DE", "LC_ALL": "C"}, "en"),
        ({"LANG": "en_US", "LC_MESSAGES": "de"}, "de"),
        ({"LANG": "de_DE", "LANGUAGE": "xx:en:de"}, "en"),
        ({"LANG": "de_DE", "LANGUAGE": ""}, "de"),
        ({"LANG": "xx_XX"}, "en"),
    ],
)
def test_the_system_says_its_language_as_gettext_has_it(
    environment: Mapping[str, str], name: str
) -> None:
    assert language.system_language(environment) == name


@pytest.mark.sweep
def test_a_language_is_chosen_on_the_page_of_the_settings_and_all_changes_at_once(
    person: Person,
) -> None:
    person.window.open_level("newton/atwood")
    choose(person, "Deutsch")
    assert person.window.panels.controls.button("help").text == "Hilfe"
    assert person.side.tab("forces page").text == "Kräfte"
    assert person.window.panels.list is not None
    assert person.window.panels.list.link_button("home").text == "Übersicht"
    choose(person, "English")

    assert person.window.panels.controls.button("help").text == "Help"


def test_a_run_goes_on_while_the_language_changes(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling(duration=20.0))
    person.press(pygame.K_SPACE, " ")
    person.wait(0.2)
    session, world, steps = person.session, person.session.world, person.session.world.steps
    choose(person, "Deutsch")

    assert person.session is session
    assert session.world is world
    assert session.playing
    assert world.steps > steps
    assert person.window.panels.controls.button("play").text == "Pause"


def test_what_is_told_of_a_run_that_is_over_changes_too(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    turn_to(person, "effects")
    page = person.page(EffectsPage)
    person.click(page.switch("gravity").rect)
    assert person.session.changes.label == "without gravity"
    choose(person, "Deutsch")

    assert person.session.changes.label == "ohne Schwerkraft"


def test_a_language_is_kept_for_the_next_window(person: Person) -> None:
    person.window.open_level("newton/atwood")
    choose(person, "Deutsch")

    assert preferences.WindowPreferences().language == "de"


def test_until_one_is_chosen_it_is_that_of_the_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LANGUAGE", "de_CH:en")

    assert preferences.WindowPreferences().language == "de"


def test_a_message_without_words_is_none() -> None:
    """gettext keeps the head of a catalogue under the empty message."""
    language.use("de")
    try:
        assert language.say("") == ""
    finally:
        language.use(language.ENGLISH)


def test_the_level_that_is_listened_to_has_words_wherever_a_level_may_have_some() -> None:
    """So the texts of a new field are checked on the pages, too."""
    fields = set(worded(Level))
    steps = {step for path in fields for step in path}
    found = {tuple(step for step in path if step in steps) for path, _ in prose(parse(shipped()))}

    assert len(fields) > 5
    assert found == fields


def test_what_is_not_said_through_the_catalogue_is_found(speech: Speech) -> None:
    speech.heard |= {"Forces", "FORCES", "B.position.x", "2 kg", "Forces ON B"}

    assert list(speech.small(set())) == ["Forces", "Forces ON B"]


@pytest.mark.sweep
def test_nothing_is_drawn_or_told_as_it_stands_in_the_code() -> None:
    """Texts that no test reaches are found in the sources, where they are passed without `say`."""
    found = []
    for path in sorted(Path(app.__file__).parent.rglob("*.py")):
        calls = (n for n in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(n, ast.Call))
        shown = (call for call in calls if ast.unparse(call.func).rpartition(".")[2] in SHOWING)
        found += [f"{path.name}: {text}" for call in shown for text in bare(call)]

    assert found == []


def bare(call: ast.Call) -> Iterator[str]:
    """Yield the arguments of a call that are texts, formatted ones included."""
    for given in (*call.args, *(keyword.value for keyword in call.keywords)):
        for each in (given.body, given.orelse) if isinstance(given, ast.IfExp) else (given,):
            parts = each.values if isinstance(each, ast.JoinedStr) else [each]
            words = [part.value for part in parts if isinstance(part, ast.Constant)]
            if any(isinstance(word, str) and re.search("[a-z]{3}", word) for word in words):
                yield ast.unparse(each)


@pytest.mark.parametrize("page", thinned(PAGES, 3), ids=[page.name for page in PAGES])
def test_all_that_a_page_writes_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path, page: Page
) -> None:
    person.open(tmp_path, shipped())
    person.press(pygame.key.key_code(page.key), page.key)
    person.wait(0.1)
    heard(speech, person)
    person.press(pygame.K_SPACE, " ")
    until(person, lambda: not person.session.playing)
    person.press(pygame.K_h, "h")
    heard(speech, person)


def test_what_is_written_of_changed_effects_and_of_a_race_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, shipped())
    turn_to(person, "effects")
    effects = person.page(EffectsPage)
    person.click(effects.switch("drag").rect)
    person.press(pygame.K_SPACE, " ")
    until(person, lambda: not person.session.playing)
    heard(speech, person)
    person.click(effects.reset.rect)
    turn_to(person, "scheme_race")
    race = person.page(RacePage)
    person.click(race.button.rect)
    person.press(pygame.K_SPACE, " ")
    person.wait(0.3)
    heard(speech, person)


def test_what_is_written_of_a_prediction_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, shipped())
    turn_to(person, "predict")
    page = person.page(PredictPage)
    person.click(page.button.rect)
    person.type("Q")
    person.press(pygame.K_RETURN)
    heard(speech, person)
    person.type("6")
    person.press(pygame.K_RETURN)
    until(person, lambda: not person.session.playing and not person.window.workers.running)
    heard(speech, person)


def test_what_is_written_of_a_challenge_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, shipped())
    turn_to(person, "challenge")
    page = person.page(ChallengePage)
    for _ in range(2):
        person.click(page.button.rect)
    person.press(pygame.K_SPACE, " ")
    until(person, lambda: not person.session.playing)
    heard(speech, person)


def test_what_is_written_while_somebody_builds_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, shipped())
    builder = Builder(person)
    builder.at(0, 5)
    heard(speech, person)
    for digit in "12345678":
        person.press(pygame.key.key_code(digit), digit)
        builder.at(-4, 3)
        heard(speech, person)
    person.press(pygame.K_ESCAPE)
    person.press(pygame.K_s, "s", pygame.KMOD_LCTRL | pygame.KMOD_LSHIFT)
    heard(speech, person)


@pytest.mark.parametrize("command", ["home", "energy", "open file"])
def test_what_else_the_window_writes_is_said_in_the_language(
    speech: Speech, person: Person, tmp_path: Path, command: str
) -> None:
    person.open(tmp_path, shipped())
    for _ in range(3):
        person.window.do(command)
        person.wait(0.1)
        heard(speech, person)


def test_a_level_that_cannot_be_opened_is_told_in_the_language(
    speech: Speech, person: Person, tmp_path: Path
) -> None:
    """So are its mistakes, each at its place."""
    ball = {"type": "dynamic", "shape": {"type": "disc", "radius": -1}, "position": ["2m", 0]}
    effects = {"gravitee": {}, "drag": {"linear": "1/0", "quadratic": True}}
    person.open(tmp_path, json.dumps({"format": 1, "effects": effects, "bodies": {"B": ball}}))
    speech.look(person)
    said = [text for text in speech.heard if "EFFECTS.GRAVITEE" in text.upper()]

    assert "THIS LEVEL CANNOT BE OPENED" in speech.heard
    assert any("UNKNOWN EFFECT 'gravitee'; DID YOU MEAN 'gravity'?" in text for text in said)
    assert any("A PRODUCT IS WRITTEN 2*M, NOT 2M" in text for text in speech.heard)
    assert any("'title' IS MISSING" in text for text in speech.heard)
    assert speech.capitals.strays == set()


@pytest.mark.parametrize("scale", [1.0, 2.0])
@pytest.mark.parametrize("name", language.NAMES)
def test_no_name_of_an_account_lies_on_its_bar(
    monkeypatch: pytest.MonkeyPatch, name: language.Name, scale: float
) -> None:
    """In German, losses by drag have a name of 150 px, wider than any in English."""
    accounts = dict.fromkeys(EFFECTS, 1.0)
    books = Balance(1.0, accounts, accounts, accounts, 0.0, {}, np.zeros(3), 0.0)
    parts: list[pygame.Rect] = []
    put = TextColumn.put

    def noted(card: TextColumn, part: pygame.Surface, x: int, y: int = 0) -> None:
        parts.append(part.get_rect(topleft=(x, card.y + y)))
        put(card, part, x, y)

    monkeypatch.setattr(TextColumn, "put", noted)
    pygame.font.init()
    language.use(name)
    try:
        ledger(Pen(scale), round(270 * scale), books, "")
    finally:
        language.use(language.ENGLISH)

    shared = [one.clip(other) for one, other in combinations(parts, 2)]
    assert [part for part in shared if part.width and part.height > 2] == []
