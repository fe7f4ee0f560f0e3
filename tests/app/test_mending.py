"""A level's file is mended or changed while its window is open."""

import os
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.cards.mistakes import excerpt, groups
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.model.errors import LevelError, Mistake
from sandbox.model.file_watching import PAUSE
from sandbox.model.loading import parse
from sandbox.model.translatable_message import Message
from tests.app import scenes
from tests.app.person import Person

NOTICED = 4 * PAUSE
"""s, after which a change has been seen, and seen to be complete."""

WRONG = scenes.falling(effects={"gravty": {"acceleration": [0, "-g"]}})


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "level.json"


def write(path: Path, text: str) -> None:
    """Save a file as an editor does, at another time than before, however coarse the clock."""
    before = path.stat().st_mtime_ns if path.is_file() else 0
    path.write_text(text, encoding="utf-8")
    os.utime(path, ns=(before + 10**9, before + 10**9))


def told(person: Person) -> str:
    return person.window.banner._note


def test_a_mended_level_opens_by_itself(person: Person, tmp_path: Path, path: Path) -> None:
    person.open(tmp_path, WRONG)
    assert person.window.session is None

    write(path, scenes.falling())
    person.wait(NOTICED)

    assert person.session.level.title == "A falling ball"
    assert person.window.panels.refusal is None


def test_the_page_follows_while_mistakes_are_mended_one_by_one(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, WRONG)
    write(path, scenes.falling(duration=-1))
    person.wait(NOTICED)

    assert person.window.panels.refusal is not None
    assert "duration" in person.window.panels.refusal.text
    assert "gravty" not in person.window.panels.refusal.text


def test_a_file_that_is_still_being_written_is_left_alone(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    for length in range(0, 400, 100):
        write(path, scenes.falling(title="A stone")[:length])
        person.wait(PAUSE + 0.02)
        assert person.session.level.title == "A falling ball"
        assert told(person) == ""

    write(path, scenes.falling(title="A stone"))
    person.wait(NOTICED)

    assert person.session.level.title == "A stone"


def test_a_run_that_nobody_touched_begins_anew_with_what_the_file_says(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_RIGHT)

    write(path, scenes.falling(title="A stone"))
    person.wait(NOTICED)

    assert person.session.level.title == "A stone"
    assert "was read again" in told(person)


def test_what_was_done_by_hand_is_kept_until_a_key_says_otherwise(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    person.drag(person.on_screen((0, 5)), person.on_screen((3, 2)))

    write(path, scenes.falling(title="A stone"))
    person.wait(NOTICED + 10)

    assert person.session.level.title == "A falling ball"
    assert told(person) == "level.json has changed; F5 reads it again"
    person.press(pygame.K_F5)
    assert person.session.level.title == "A stone"
    assert told(person) == ""


def test_a_change_for_the_worse_interrupts_nobody(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    write(path, WRONG)
    person.wait(NOTICED)

    assert person.session.level.title == "A falling ball"
    assert told(person) == "level.json has mistakes now; F5 shows them"
    write(path, scenes.falling())
    person.wait(NOTICED)
    assert told(person) == ""


def test_a_file_that_says_the_same_in_another_layout_is_no_news(
    person: Person, tmp_path: Path, path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    session = person.session

    write(path, scenes.falling().replace(", ", ",\n"))
    person.wait(NOTICED)

    assert person.session is session
    assert told(person) == ""


def test_a_file_that_goes_may_come_back(person: Person, tmp_path: Path, path: Path) -> None:
    person.open(tmp_path, WRONG)
    path.unlink()
    person.wait(NOTICED)
    assert person.window.panels.refusal is not None
    assert "there is no such file" in person.window.panels.refusal.text

    write(path, scenes.falling())
    person.wait(NOTICED)

    assert person.session.level.title == "A falling ball"


def mistakes(text: str) -> tuple[Mistake, ...]:
    with pytest.raises(LevelError) as caught:
        parse(text)
    return caught.value.mistakes


LONG = 18  # px


def carets(drawn: pygame.Surface) -> list[pygame.Rect]:
    """Return the red bars that are longer than a letter is high, from above: the underlines."""
    red = (pygame.surfarray.array3d(drawn) == theme.FAILED).all(axis=2).T
    found: list[pygame.Rect] = []
    for y, row in enumerate(red):
        starts, ends = np.flatnonzero(np.diff(np.r_[0, row, 0])).reshape(-1, 2).T
        for x, end in zip(starts, ends, strict=True):
            bar = pygame.Rect(int(x), y, int(end - x), 1)
            if bar.width >= LONG and not bar.move(0, -1).collidelistall(found):
                found.append(bar)
    return found


def test_a_caret_stands_below_what_is_wrong(pen: Pen) -> None:
    text = scenes.falling(effects={"gravty": {}}).replace(', "', ',\n  "')
    found = mistakes(text)
    line = text.split("\n")[(found[0].line or 1) - 1]
    font = pen.spare(13)

    drawn = excerpt(pen, 600, text.split("\n"), found[:1])

    (caret,) = carets(drawn)
    assert line[(found[0].column or 1) - 1 :].startswith('"gravty"')
    assert caret.width == pytest.approx(font.size('"gravty"')[0], abs=1)


def test_in_a_file_of_one_long_line_each_place_is_shown(pen: Pen) -> None:
    text = scenes.falling(effects={"gravty": {}}, duration=-1)
    found = mistakes(text)
    assert {mistake.line for mistake in found} == {1}

    drawn = excerpt(pen, 500, text.split("\n"), found)

    marked = carets(drawn)
    assert len(found) == 2
    assert len(marked) == 2
    assert all(0 < caret.x < 500 for caret in marked)


def test_mistakes_far_apart_have_excerpts_of_their_own() -> None:
    near = [Mistake("x", line, 1, "", Message("is wrong")) for line in (3, 5, 90)]

    assert [[each.line for each in group] for group in groups(near)] == [[3, 5], [90]]


@pytest.mark.parametrize("text", ["", "\0", "{", "[1,", '{"a": 1}', "\t\u200b{", "née\u0301 {"])
@pytest.mark.parametrize("width", [40, 700])
def test_any_text_can_be_shown(pen: Pen, text: str, width: int) -> None:
    found = mistakes(text)

    for lines in (text.split("\n"), []):  # the file may be another one by now
        for group in groups(found):
            assert excerpt(pen, width, lines, group).width == width


def test_a_page_of_many_mistakes_is_scrolled_by_keyboard(person: Person, tmp_path: Path) -> None:
    bodies = {f"b{i}": {"mas": 1} for i in range(40)}
    person.open(tmp_path, scenes.falling(bodies=bodies).replace(', "', ',\n  "'))
    before = pygame.image.tobytes(person.window.surface, "RGB")

    person.press(pygame.K_PAGEDOWN)
    person.wait(0.1)

    assert pygame.image.tobytes(person.window.surface, "RGB") != before
