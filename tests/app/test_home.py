"""The levels as cards."""

import os
import time
from itertools import islice
from multiprocessing import Pipe
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.banner import NOTE
from sandbox.app.building.editor import Editor
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files import challenge_stars
from sandbox.app.home import picture_cache, unfinished_work_strip
from sandbox.app.home.level_gallery import LevelGallery
from sandbox.app.home.picture_cache import SIZE
from sandbox.app.home.thumbnails import Thumbnails
from sandbox.app.words.language import say
from sandbox.editing.draft import Draft
from sandbox.editing.draft_recovery import Recovery, recoverable
from sandbox.model import level_catalog, unsaved_files
from tests.app import scenes
from tests.app.person import PATIENCE, Person, until

ATWOOD = "newton/atwood"


@pytest.fixture
def few() -> int:
    """Cards in several rows, of two chapters."""
    return 12


@pytest.fixture
def visitor(person: Person) -> Person:
    """A person who plays a level and returns to the home page."""
    person.window.open_level("kinematics/free-fall")
    person.wait()
    person.press(pygame.K_F2)
    return person


def home(person: Person) -> LevelGallery:
    return person.window.panels.home


def titles(person: Person) -> list[str]:
    return [level.title for level, _ in home(person).grid.cards]


def card(person: Person, title: str) -> pygame.Rect:
    return home(person).card_rect(titles(person).index(title))


def focused(person: Person) -> str:
    entry = home(person).focus
    assert entry is not None
    return entry.title


@pytest.mark.parametrize("key", [pygame.K_F2, pygame.K_BACKSPACE])
def test_a_key_leads_home_and_back(person: Person, key: int) -> None:
    person.window.open_level("kinematics/free-fall")
    session = person.session

    person.press(key)
    assert home(person).open
    assert focused(person) == "Free fall"
    person.press(key)

    assert not home(person).open
    assert person.session is session


def test_a_button_above_the_list_leads_home(person: Person) -> None:
    person.window.open_level("kinematics/free-fall")
    person.wait()
    assert person.window.panels.list is not None

    person.click(person.window.panels.list.link_button("home").rect)

    assert home(person).open


def test_all_levels_of_the_list_have_a_card_in_its_order(visitor: Person) -> None:
    assert visitor.window.panels.list is not None
    assert titles(visitor) == [level.title for level in visitor.window.panels.list.matching_levels]


def test_a_click_opens_a_level(visitor: Person) -> None:
    visitor.click(card(visitor, "Projectile"))

    assert visitor.session.level.title == "Projectile"
    assert not home(visitor).open


def test_a_card_that_is_left_before_the_button_is_let_go_of_is_not_opened(visitor: Person) -> None:
    place = card(visitor, "Projectile")
    visitor.move(place.center)
    visitor.button(True, place.center)
    visitor.move(card(visitor, "Free fall").center)
    visitor.button(False, card(visitor, "Free fall").center)

    assert home(visitor).open


def test_arrows_walk_over_the_cards_and_enter_opens(visitor: Person) -> None:
    visitor.press(pygame.K_HOME)
    first = titles(visitor)[0]
    assert focused(visitor) == first

    visitor.press(pygame.K_LEFT)
    visitor.press(pygame.K_UP)
    assert focused(visitor) == first
    visitor.press(pygame.K_RIGHT)
    assert focused(visitor) == titles(visitor)[1]
    before = card(visitor, focused(visitor))
    visitor.press(pygame.K_DOWN)
    after = card(visitor, focused(visitor))
    assert (after.x, after.y > before.y) == (before.x, True)
    chosen = focused(visitor)
    visitor.press(pygame.K_RETURN, "\r")

    assert visitor.session.level.title == chosen


def test_the_card_with_the_focus_has_a_rim_and_is_in_view(visitor: Person) -> None:
    for _ in range(4):
        visitor.press(pygame.K_DOWN)
    place = card(visitor, focused(visitor))

    assert visitor.window.panels.layout.stage.contains(place)
    assert visitor.color_at((place.centerx, place.y)) == theme.ACCENT
    visitor.press(pygame.K_UP)
    left = card(visitor, titles(visitor)[-1])
    assert visitor.color_at((left.centerx, left.y)) != theme.ACCENT


def test_the_wheel_scrolls_as_far_as_there_are_cards(visitor: Person) -> None:
    stage = visitor.window.panels.layout.stage
    visitor.move(stage.center)
    for _ in range(60):
        wheel = pygame.Event(pygame.MOUSEWHEEL, x=0, y=-1, precise_x=0.0, precise_y=-1.0)
        pygame.event.post(wheel)
    visitor.wait()

    last = card(visitor, titles(visitor)[-1])
    assert stage.contains(last)
    assert last.bottom > stage.bottom - 100


def test_the_card_that_the_wheel_brings_under_the_mouse_is_lit(visitor: Person) -> None:
    visitor.resize((900, 600))
    mouse = home(visitor).card_rect(0).center
    visitor.move(mouse)

    for _ in range(20):
        wheel = pygame.Event(pygame.MOUSEWHEEL, x=0, y=-1, precise_x=0.0, precise_y=-1.0)
        pygame.event.post(wheel)
    visitor.wait()

    places = [home(visitor).card_rect(i) for i in range(len(home(visitor).grid.cards))]
    (under,) = (place for place in places if place.collidepoint(mouse))
    assert under != places[0]
    assert visitor.color_at((under.right - 8, under.bottom - 4)) == theme.RAISED


def test_what_acts_on_the_level_shows_it_again(visitor: Person) -> None:
    visitor.press(pygame.K_r, "r")

    assert not home(visitor).open


def test_the_bar_below_the_cards_leads_back_and_nothing_on_it_acts_on_the_hidden_run(
    person: Person,
) -> None:
    person.window.open_level("kinematics/free-fall")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.2)
    person.press(pygame.K_F2)
    bar = person.window.panels.controls
    steps = person.session.world.steps

    for x in range(0, bar._rect.width, 20):  # where the time could be dragged to
        if not any(b.rect.collidepoint(x, bar._rect.centery) for b in bar._buttons.values()):
            person.click((x, bar._rect.centery))
    assert (person.session.world.steps, person.session.sought) == (steps, None)
    assert set(bar._buttons) == {"home", "challenges", "help"}

    person.click(bar.button("home").rect)
    assert not home(person).open
    assert person.window.panels.controls.button("play")


@pytest.mark.parametrize("size", [(900, 600), (1280, 800)])
def test_the_bar_below_the_cards_is_not_crowded_in_any_language(
    person: Person, size: tuple[int, int]
) -> None:
    person.window.comfort.choose(language="de", size=150)
    person.window.open_level("kinematics/free-fall")
    person.resize(size)
    person.press(pygame.K_F2)

    rects = [b.rect for b in person.window.panels.controls._buttons.values()]
    assert all(person.window.surface.get_rect().contains(rect) for rect in rects)
    assert not any(a.colliderect(b) for i, a in enumerate(rects) for b in rects[:i])


def test_time_stands_while_nobody_sees_it_pass(person: Person) -> None:
    person.window.open_level("kinematics/free-fall")
    person.press(pygame.K_SPACE, " ")
    person.press(pygame.K_F2)
    steps = person.session.world.steps
    person.wait(0.2)

    assert person.session.world.steps == steps


def test_a_body_below_the_cards_is_not_dragged(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling())
    place = person.on_screen((0, 5))
    person.press(pygame.K_F2)

    person.drag(place, (place[0] + 80, place[1] + 80))

    assert not person.session.world.disturbed


def test_escape_goes_back_before_it_quits(visitor: Person) -> None:
    visitor.press(pygame.K_ESCAPE)
    assert (home(visitor).open, visitor.window.open) == (False, True)

    visitor.press(pygame.K_ESCAPE)
    assert visitor.window.open
    visitor.press(pygame.K_ESCAPE)
    assert not visitor.window.open


def test_escape_that_was_hit_some_time_ago_counts_no_longer(visitor: Person) -> None:
    visitor.press(pygame.K_ESCAPE)
    visitor.press(pygame.K_ESCAPE)
    visitor.wait(NOTE)
    visitor.press(pygame.K_ESCAPE)

    assert visitor.window.open


@pytest.mark.all_levels
def test_what_is_looked_for_stands_first_among_the_cards(visitor: Person) -> None:
    visitor.press(pygame.K_SLASH, "/")
    visitor.type("cradle")

    assert titles(visitor)[0] == focused(visitor) == "Newton's cradle"
    assert len(titles(visitor)) < 10
    visitor.press(pygame.K_RETURN, "\r")
    assert visitor.session.level.title == "Newton's cradle"


def test_nonsense_leaves_no_card_and_no_key_is_dangerous(visitor: Person) -> None:
    visitor.press(pygame.K_SLASH, "/")
    visitor.type("xyzzy")
    assert titles(visitor) == []
    visitor.window.panels.manager.set_focus_set(None)

    for key in (pygame.K_RETURN, pygame.K_DOWN, pygame.K_END, pygame.K_PAGEDOWN):
        visitor.window.panels.home.process(pygame.Event(pygame.KEYDOWN, key=key, mod=0, unicode=""))
    visitor.wait()

    assert visitor.window.open


@pytest.mark.parametrize("size", [(480, 300), (900, 600), (1280, 800), (1920, 1080)])
def test_cards_fill_the_width_and_never_overlap(visitor: Person, size: tuple[int, int]) -> None:
    visitor.resize(size)
    visitor.wait()

    stage = visitor.window.panels.layout.stage
    places = [home(visitor).card_rect(i) for i in range(len(titles(visitor)))]
    assert all(len(place.collidelistall(places)) == 1 for place in places)
    assert min(place.left for place in places) - stage.left < 40
    assert stage.right - max(place.right for place in places) < 50
    assert all(stage.left <= place.left and place.right <= stage.right for place in places)


def test_the_first_picture_waits_for_no_card(person: Person) -> None:
    person.window.open_level("kinematics/free-fall")
    person.window.do("home")
    assert not home(person).thumbnails.running

    person.wait()

    place = card(person, "Free fall")
    assert home(person).thumbnails.of(level_catalog.find("kinematics/free-fall").resolve()) is None
    assert person.color_at((place.x + 20, place.y + 20)) == theme.GRID


def test_pictures_come_in_and_are_found_again_on_disk(
    person: Person, tmp_path: Path, pen: Pen
) -> None:
    """The test puts them where another process would."""
    path = tmp_path / "level.json"
    person.open(tmp_path, scenes.falling())
    pygame.image.save(drawn := picture_cache.draw(path, pen), tmp_path / "x.png")
    picture_cache.folder().mkdir()
    kept = picture_cache.folder() / f"{picture_cache.key(path)}.png"
    kept.write_bytes((tmp_path / "x.png").read_bytes())

    person.press(pygame.K_F2)
    person.wait(0.2)

    shown = home(person).thumbnails.of(path.resolve())
    assert shown is not None
    wanted = pygame.transform.smoothscale(drawn, shown.size)
    assert np.array_equal(pygame.surfarray.array3d(shown), pygame.surfarray.array3d(wanted))


def test_pictures_are_drawn_in_the_background_what_is_seen_first(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_F2)
    thumbnails = home(person).thumbnails
    until(person, lambda: thumbnails.running)

    until(person, lambda: thumbnails.of(tmp_path / "level.json") is not None)

    assert list(picture_cache.folder().glob("*.png"))
    person.press(pygame.K_F2)
    assert not thumbnails.running


@pytest.mark.sweep
def test_a_level_that_cannot_be_drawn_says_so(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling(duration=-1))
    person.press(pygame.K_F2)

    until(person, lambda: home(person).thumbnails.hopeless(tmp_path / "level.json"))


def made(*paths: Path) -> list[picture_cache.Picture]:
    """Return the pictures of levels, drawn by one order; EOFError if there are none."""
    orders, order = Pipe(duplex=False)
    order.send(list(paths))
    if not paths:
        order.close()
    return [*islice(picture_cache.draw_all(picture_cache.folder(), orders), max(len(paths), 1))]


@pytest.mark.sweep
def test_one_process_draws_whatever_cards_come_into_view() -> None:
    """It was ended and begun anew with each letter of a search, and drew nothing meanwhile."""
    pygame.display.set_mode((100, 100))
    names = ("free-fall", "components", "projectile")
    levels = [level_catalog.find(f"kinematics/{name}") for name in names]
    thumbnails, deadline = Thumbnails(), time.monotonic() + PATIENCE
    pids: set[int | None] = set()
    try:
        for level in levels:
            for _ in range(5):
                thumbnails.follow([level], [level])
                pids.add(thumbnails._work.pid)
        while thumbnails.of(levels[-1]) is None:
            assert time.monotonic() < deadline
            thumbnails.follow(levels[-1:], levels[-1:])
            pids.add(thumbnails._work.pid)
            time.sleep(0.01)
    finally:
        thumbnails.cancel()

    assert len(pids - {None}) == 1


def test_a_level_is_drawn_anew_when_its_file_says_something_else(tmp_path: Path) -> None:
    path = tmp_path / "level.json"
    path.write_text(scenes.falling())
    (first,) = made(path)
    path.write_text(scenes.falling(title="A stone"))
    (second,) = made(path)

    assert first.key != second.key
    assert pygame.image.load(picture_cache.folder() / f"{first.key}.png").get_size() == SIZE


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n", b"nonsense"])
def test_half_a_picture_counts_as_none(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "level.json"
    path.write_text(scenes.falling())
    picture_cache.folder().mkdir()
    (picture_cache.folder() / f"{picture_cache.key(path)}.png").write_bytes(content)

    (drawn,) = made(path)

    assert picture_cache.cached(drawn.key) == drawn.png != b""


def test_a_folder_that_takes_no_pictures_is_no_reason_to_show_none(tmp_path: Path) -> None:
    path = tmp_path / "level.json"
    path.write_text(scenes.falling())
    picture_cache.folder().write_text("a file where the folder should be")

    (drawn,) = made(path)

    assert drawn.png


def test_no_level_holds_up_the_others(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture_cache, "PATIENCE", 0.2)
    begun = time.monotonic()

    picture_cache.draw(level_catalog.find("hard/gas-of-60"), pen)

    assert time.monotonic() - begun < PATIENCE / 4


def test_stars_that_were_earned_stand_on_the_card(visitor: Person) -> None:
    place = card(visitor, "Free fall")
    words = pygame.Rect(place.x, place.bottom - 46, place.width, 24)

    def golden() -> int:
        seen = pygame.surfarray.array3d(visitor.window.surface.subsurface(words))
        return int((seen == theme.NOTICE).all(axis=2).sum())

    assert golden() == 0
    challenge_stars.ChallengeStars().earn("Free fall", 1)
    visitor.press(pygame.K_F2)
    visitor.press(pygame.K_F2)
    one = golden()
    challenge_stars.ChallengeStars().earn("Free fall", 3)
    visitor.press(pygame.K_F2)
    visitor.press(pygame.K_F2)

    assert one > 10
    assert golden() == 3 * one


def test_what_is_kept_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture_cache, "MOST", 3)
    picture_cache.folder().mkdir()
    for i in range(5):
        path = picture_cache.folder() / f"{i}.png"
        path.write_bytes(b"")
        os.utime(path, (i, i))

    with pytest.raises(EOFError):
        made()

    assert sorted(path.stem for path in picture_cache.folder().iterdir()) == ["2", "3", "4"]


def drawn_and_lost(title: str) -> str:
    """Leave a draft behind, as a window that crashed does, and return its text."""
    draft = Draft.of(scenes.falling())
    draft.change(scenes.falling(title=title), "rename")
    assert Recovery().keep(draft) == ""
    unsaved_files._OPEN.clear()  # nobody has it open any more
    return draft.text


def test_what_was_not_saved_is_offered_above_the_cards_and_gone_on_with(
    person: Person,
) -> None:
    text = drawn_and_lost("Lost and found")
    person.window.open_level("kinematics/free-fall")
    person.press(pygame.K_F2)
    person.wait()
    (left,) = recoverable()
    assert unfinished_work_strip.summary(left).startswith("Not saved: Lost and found, drawn ")
    assert card(person, "Free fall").top > home(person).strip.rect_of(0).bottom

    person.click(home(person).strip.rect_of(0))
    person.wait(0.1)

    assert not home(person).open
    assert person.session.original.title == "Lost and found"
    assert person.window.workers.of(Editor).work.draft.text == text
    person.press(pygame.K_F2)
    assert recoverable() == []  # it is this window's own now
    assert home(person).card_rect(0).top < 2 * picture_cache.SIZE[1]


def test_a_drawing_that_nobody_has_named_is_offered_in_the_language_of_the_window() -> None:
    """It was called New level in German, too."""
    drawn_and_lost("New level")
    (left,) = recoverable()

    assert unfinished_work_strip.summary(left).startswith(
        "Not saved: a level without a name, drawn "
    )


def test_without_drafts_the_cards_have_all_the_room(visitor: Person) -> None:
    stage = visitor.window.panels.layout.stage

    assert home(visitor).strip.take_room(stage) == stage


def test_a_draft_that_says_no_title_is_offered_all_the_same() -> None:
    draft = Draft.of(scenes.falling())
    draft.change("{", "break it")
    assert Recovery().keep(draft) == ""
    unsaved_files._OPEN.clear()

    (left,) = recoverable()

    assert "a level without a name" in unfinished_work_strip.summary(left)


def test_a_chapter_above_the_cards_leads_to_its_own(visitor: Person) -> None:
    """Twelve cards are of two chapters; the window is so low that only one chapter is visible."""
    visitor.resize((900, 600))
    bar, (first, second) = home(visitor).chapters, home(visitor).grid.headings

    visitor.click(bar.rect_of(second.text))

    entry = home(visitor).focus
    assert entry is not None
    assert say(entry.chapter.capitalize()) == second.text
    assert home(visitor)._top > first.y
    assert (
        home(visitor).card_rect(titles(visitor).index(entry.title)).colliderect(home(visitor)._area)
    )
    visitor.click(bar.rect_of(first.text))
    assert home(visitor)._top < second.y


def test_what_is_found_has_no_bar_of_chapters(visitor: Person) -> None:
    top = visitor.window.panels.layout.stage.y
    assert home(visitor)._area.y > top

    visitor.press(pygame.K_SLASH, "/")
    visitor.type("fall")
    visitor.wait()

    assert home(visitor)._area.y == top
