"""The page of a challenge, as a player sees it."""

from pathlib import Path

import pygame
import pytest

from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.pages.challenge.card import NONE
from sandbox.app.pages.challenge.panel import ChallengePage
from sandbox.app.panels.level_list import LevelList
from sandbox.app.runs import run_file
from sandbox.model import level_catalog
from tests.app.person import Person

LEVEL = "challenges/stop-dead"


def play_to_the_end(person: Person) -> None:
    person.press(pygame.K_SPACE, " ")
    wait_for_the_end(person)


def wait_for_the_end(person: Person) -> None:
    while person.session.playing:
        person.wait()
    person.wait(0.2)


def test_a_level_with_a_challenge_opens_on_its_page_and_others_do_not(person: Person) -> None:
    person.window.open_level(LEVEL)
    assert person.window.panels.page == "challenge page"

    person.window.open_level("newton/atwood")
    assert person.window.panels.page == "level page"


def test_a_page_that_was_chosen_stays_when_another_level_is_opened(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_x, "x")
    person.window.open_level("kinematics/projectile")

    assert person.window.panels.page == "effects page"


def test_only_free_parameters_can_be_changed_here(person: Person) -> None:
    person.window.open_level(LEVEL)
    person.wait()

    side = person.side
    assert side.parameters.row("m2")
    assert set(side.parameters._rows) == {"m2", "v1"}


def test_a_solved_challenge_earns_its_stars_and_its_title_a_mark(person: Person) -> None:
    person.window.open_level(LEVEL)
    play_to_the_end(person)
    assert ChallengeStars().stars("Stop dead") == 0

    person.session.restart({"m2": 2, "v1": 3})
    play_to_the_end(person)

    attempt = person.session.attempt()
    assert attempt is not None
    assert attempt.stars == 3
    assert ChallengeStars().stars("Stop dead") == 3
    banner = person.window.banner
    banner.write("")
    assert banner._complete(person.session).startswith("3 of 3 stars – ")
    person.window.open_level("newton/atwood")
    person.window.open_level(LEVEL)
    listed = person.window.panels.list
    assert isinstance(listed, LevelList)
    assert listed.button(level_catalog.find(LEVEL).resolve()).text.endswith("•••")


def test_a_title_that_is_seen_has_its_mark_as_soon_as_the_stars_are_earned(
    person: Person, tmp_path: Path
) -> None:
    own = tmp_path / "own.json"
    own.write_bytes(level_catalog.find(LEVEL).read_bytes())
    person.window.open_level(str(own))
    person.wait()
    listed = person.window.panels.list
    assert isinstance(listed, LevelList)
    row = listed.button(own.resolve())
    assert (row.text, row.tool_tip_text) == ("Stop dead", None)

    person.session.restart({"m2": 2, "v1": 3})
    play_to_the_end(person)

    assert (row.text, row.tool_tip_text) == ("Stop dead   •••", "3 stars earned")


def test_fewer_stars_than_before_change_nothing(person: Person) -> None:
    person.window.open_level(LEVEL)
    person.session.restart({"m2": 2, "v1": 3})
    play_to_the_end(person)
    person.session.restart({"v1": 2})
    play_to_the_end(person)

    attempt = person.session.attempt()
    assert attempt is not None
    assert attempt.stars == 2
    assert ChallengeStars().stars("Stop dead") == 3


def test_a_hand_earns_no_stars(person: Person) -> None:
    person.window.open_level(LEVEL)
    person.session.restart({"m2": 2, "v1": 3})
    person.session.grab("second", (0, 0))
    person.session.drag((1, 0))
    person.session.release()

    assert person.session.attempt() is None
    play_to_the_end(person)
    assert ChallengeStars().stars("Stop dead") == 0


def test_a_run_from_a_file_earns_no_stars(person: Person, tmp_path: Path) -> None:
    """Somebody else may have made it, for a level that makes it easy."""
    person.window.open_level(LEVEL)
    person.session.restart({"m2": 2, "v1": 3})
    path = tmp_path / f"won{run_file.SUFFIX}"
    run_file.save(run_file.run_of(person.session), path)

    person.window.open_level(str(path))
    wait_for_the_end(person)

    attempt = person.session.attempt()
    assert attempt is not None
    assert attempt.stars == 3
    assert ChallengeStars().stars("Stop dead") == 0
    assert "earns none" in person.window.banner._note


def test_hints_come_one_after_the_other_and_then_no_more(person: Person) -> None:
    person.window.open_level(LEVEL)
    person.wait()
    before = person.page(ChallengePage)._hints.image.get_height()

    person.press(pygame.K_PAGEDOWN)
    person.click(person.page(ChallengePage).button.rect)
    first = person.page(ChallengePage)._hints.image.get_height()
    person.press(pygame.K_PAGEDOWN)
    person.click(person.page(ChallengePage).button.rect)

    assert before < first < person.page(ChallengePage)._hints.image.get_height()
    assert not person.page(ChallengePage).button.visible


def test_a_level_without_a_challenge_says_where_there_are_some(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_k, "k")

    assert person.page(ChallengePage)._shown_hints == ()
    assert "chapter Challenges" in NONE


@pytest.mark.all_levels
def test_a_button_leads_from_any_level_to_the_challenges(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_k, "k")
    person.wait()

    person.click(person.page(ChallengePage).others.rect)

    home = person.window.panels.home
    assert home.open
    assert home.focus is not None
    assert home.focus.chapter == level_catalog.CHALLENGES
    heading = next(each for each in home.grid.headings if each.text == "Challenges")
    assert home._top == heading.y
