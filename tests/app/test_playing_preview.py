"""A level plays on its card while the mouse rests on it."""

from pathlib import Path

import pygame
import pytest

from sandbox.app.home.level_gallery import LevelGallery
from sandbox.app.home.playing_preview import AFTER, LASTING, PlayingPreview, is_expensive
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.person import FRAME, Person

FALL = "Free fall"


@pytest.fixture
def visitor(person: Person) -> Person:
    """Somebody who looks at the cards."""
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_F2)
    person.wait()
    return person


def home(person: Person) -> LevelGallery:
    return person.window.panels.home


def card(person: Person, title: str) -> pygame.Rect:
    titles = [level.title for level, _ in home(person).grid.cards]
    return home(person).card_rect(titles.index(title))


def seen(person: Person, place: pygame.Rect) -> bytes:
    """Return the pixels of a card's picture, without its border."""
    picture = pygame.Rect(place.topleft, home(person).grid.picture).inflate(-8, -8)
    return pygame.image.tobytes(person.window.surface.subsurface(picture), "RGB")


@pytest.mark.sweep
def test_a_card_plays_while_the_mouse_rests_on_it_and_stops_when_it_is_left(
    visitor: Person,
) -> None:
    place = card(visitor, FALL)
    visitor.move(place.center)
    visitor.wait(AFTER / 2)
    assert (
        home(visitor).preview.picture(level_catalog.find("kinematics/free-fall"), (10, 10)) is None
    )

    visitor.wait(AFTER)
    early = seen(visitor, place)
    visitor.wait(0.3)
    assert seen(visitor, place) != early

    visitor.move((visitor.window.panels.layout.stage.right - 4, 300))
    visitor.wait(0.1)
    left = seen(visitor, place)
    visitor.wait(0.3)
    assert seen(visitor, place) == left
    assert not home(visitor).preview.playing
    assert visitor.session.world.steps == 0  # what is played is another run


def test_with_reduced_motion_cards_stand_still(visitor: Person) -> None:
    visitor.window.comfort.choose(reduced=True)
    visitor.move(card(visitor, FALL).center)
    visitor.wait(2 * AFTER)

    assert home(visitor).preview.path is None


def test_a_click_opens_the_level_that_plays_from_its_start(visitor: Person) -> None:
    visitor.move(card(visitor, FALL).center)
    visitor.wait(2 * AFTER)

    visitor.click(card(visitor, FALL).center)

    assert visitor.session.level.title == FALL
    assert visitor.session.world.steps == 0
    assert not home(visitor).preview.playing


@pytest.mark.parametrize(
    ("name", "expensive"),
    [("kinematics/free-fall", False), ("momentum/cradle", False), ("hard/gas-of-60", True)],
)
def test_a_level_of_many_parts_is_not_played(name: str, expensive: bool) -> None:
    assert is_expensive(load(level_catalog.find(name))) is expensive


@pytest.mark.parametrize("text", ["{", scenes.falling(bodies={})])
def test_a_file_that_cannot_be_opened_plays_nothing(tmp_path: Path, text: str) -> None:
    path = tmp_path / "broken.json"
    path.write_text(text, encoding="utf-8")
    preview = PlayingPreview()

    for _ in range(60):
        preview.follow(path, FRAME)

    assert not preview.playing
    assert preview.picture(path, (10, 10)) is None


@pytest.mark.usefixtures("pen")
def test_only_the_first_seconds_are_played(tmp_path: Path) -> None:
    pygame.display.init()
    pygame.display.set_mode((10, 10))
    path = tmp_path / "long.json"
    path.write_text(scenes.falling(duration=100, checks=[], ghosts={}), encoding="utf-8")
    preview = PlayingPreview()
    preview.follow(path, 0.0)
    preview.follow(path, AFTER)
    for _ in range(1000):
        preview.follow(path, 0.1)
        if not preview.playing:
            break

    assert preview._session is not None
    assert preview._session.t == pytest.approx(LASTING, abs=0.2)
    assert preview.picture(path, (10, 10)) is not None
