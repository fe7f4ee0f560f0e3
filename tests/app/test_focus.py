"""The keyboard's way through the widgets, by real events."""

import gc
import weakref
from pathlib import Path

import pygame
import pytest
from pygame_gui.elements import UIButton, UIHorizontalSlider

from sandbox.app.drawing import theme
from sandbox.app.pages.accuracy.panel import AccuracyPage
from sandbox.app.pages.register import PAGES
from sandbox.app.panels import keyboard_focus
from sandbox.app.widgets.text_field import TextField
from tests.app.person import Person
from tests.app.scenes import falling

MOST = 300


def tab(person: Person, *, back: bool = False) -> None:
    pygame.key.set_mods(pygame.KMOD_LSHIFT if back else 0)
    person.press(pygame.K_TAB, "\t", pygame.KMOD_LSHIFT if back else 0)
    pygame.key.set_mods(0)


def focused(person: Person) -> keyboard_focus.Stop | None:
    panels = person.window.panels
    return panels.focus.element(panels.manager, panels.layout)


def tab_to(person: Person, caption: str) -> UIButton:
    """Press Tab until a button has the focus."""
    for _ in range(MOST):
        tab(person)
        found = focused(person)
        if isinstance(found, UIButton) and found.text == caption:
            return found
    raise AssertionError(f"no button {caption}")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_tab_comes_to_every_widget_of_every_page_and_round_again(
    person: Person, tmp_path: Path, page: object
) -> None:
    person.open(tmp_path, falling())
    person.window.do(page.command)  # type: ignore[attr-defined]
    person.wait(0.05)
    panels = person.window.panels
    wanted = list(keyboard_focus.stops(panels.manager, panels.layout))
    seen = []
    for _ in wanted:
        panels.focus.move(panels.manager, panels.layout, 1)
        seen.append(focused(person))

    assert len({id(each) for each in seen}) == len(wanted) == len(seen)
    panels.focus.move(panels.manager, panels.layout, 1)
    assert focused(person) is seen[0]
    panels.focus.move(panels.manager, panels.layout, -1)
    assert focused(person) is seen[-1]


def test_a_ring_shows_where_the_keyboard_is(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    button = tab_to(person, "Restart")
    person.wait(0.05)
    middle = button.rect.centerx, button.rect.y - keyboard_focus.APART - 1
    assert person.color_at(middle) == theme.NOTICE

    person.click((600, 300))
    person.wait(0.05)
    assert person.color_at(middle) != theme.NOTICE


@pytest.mark.parametrize("key", [pygame.K_RETURN, pygame.K_SPACE])
def test_a_button_is_pressed_by_the_keyboard(person: Person, tmp_path: Path, key: int) -> None:
    person.open(tmp_path, falling())
    tab_to(person, "Step")
    person.press(key, " " if key == pygame.K_SPACE else "\r")
    person.wait(0.05)

    assert person.session.world.steps == 1
    assert not person.session.playing


def test_the_focus_stays_where_it_was_when_all_is_built_anew(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    tab_to(person, "Graph")
    before = focused(person)
    person.press(pygame.K_RETURN, "\r")
    person.wait(0.1)
    after = focused(person)

    assert isinstance(after, UIButton)
    assert after.text == "Graph"
    assert after is not before
    assert person.window.panels.page == "graph page"


def test_the_focus_stays_where_it_was_in_another_theme(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    tab_to(person, "Graph")
    person.window.comfort.choose(theme="light")
    person.wait(0.05)
    after = focused(person)

    assert isinstance(after, UIButton)
    assert after.text == "Graph"
    assert after.ui_manager is person.window.panels.manager


def test_nothing_keeps_the_widgets_of_another_theme(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    while not person.window.panels.focus._around:  # it goes to what scrolls
        tab(person)
    before = weakref.ref(person.window.panels.manager)
    person.click((600, 300))
    person.window.comfort.choose(theme="light")
    person.wait(0.05)
    gc.collect()

    assert before() is None


@pytest.mark.all_levels
def test_a_row_far_down_the_list_keeps_the_focus_when_the_window_changes(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    tab_to(person, "Wind")
    person.resize((1200, 760))
    person.wait(0.1)
    after = focused(person)

    assert isinstance(after, UIButton)
    assert after.text == "Wind"


def test_space_plays_where_no_button_has_the_focus(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    tab_to(person, "Step")
    person.press(pygame.K_ESCAPE)
    assert person.window.open
    assert focused(person) is None
    person.press(pygame.K_SPACE, " ")
    assert person.session.playing


def test_what_is_out_of_sight_is_scrolled_into_view(person: Person, tmp_path: Path) -> None:
    person.resize((900, 600))
    person.open(tmp_path, falling())
    person.window.comfort.choose(size=200)
    person.wait(0.1)
    side = person.side
    for _ in range(2):
        tab(person)
    at = focused(person)

    assert isinstance(at, TextField)
    assert side._sheet.container.rect.contains(at.rect)


def test_arrows_move_a_slider_that_has_the_focus(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.window.do("accuracy page")
    person.wait(0.05)
    page = person.page(AccuracyPage)
    for _ in range(MOST):
        tab(person)
        if isinstance(focused(person), UIHorizontalSlider):
            break
    before = page._digits
    person.press(pygame.K_RIGHT)
    person.wait(0.05)
    assert page._digits == 7 != before
    assert person.session.world.steps == 0
    person.window.workers.cancel()


def test_a_field_is_typed_over_at_once(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    tab(person)
    person.type("7")
    person.press(pygame.K_RETURN, "\r")

    assert person.session.values["g"] == 7


def test_beside_the_cards_tab_goes_through_the_list_and_enter_still_opens_a_card(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    person.window.do("home")
    person.wait(0.1)
    tab(person)
    assert person.window.panels.home.open
    assert focused(person) is not None
    person.press(pygame.K_ESCAPE)
    assert person.window.panels.home.open
    person.press(pygame.K_RETURN, "\r")
    assert not person.window.panels.home.open
