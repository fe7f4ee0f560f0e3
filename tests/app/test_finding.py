"""A level is found among many by its subject."""

import pygame
import pytest
from pygame_gui.core import UIElement

from sandbox.app.widgets.widget_states_and_scrolling import Row
from sandbox.model import level_catalog
from tests.app.person import Person

pytestmark = pytest.mark.all_levels


@pytest.fixture
def player(person: Person) -> Person:
    person.window.open_level("newton/atwood")
    person.wait()
    return person


def titles(player: Person) -> set[str]:
    return {level.title for level in player.listed.matching_levels}


@pytest.mark.sweep
def test_words_find_levels_by_what_they_are_about(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("helix")

    assert player.listed.search_text == "helix"
    assert [level.path.stem for level in player.listed.matching_levels] == ["helix", "four-slides"]


def test_a_title_comes_before_a_summary_and_a_phrase_before_its_words(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("cradle")
    found = [level.title for level in player.listed.matching_levels]
    assert found[0] == "Newton's cradle"
    assert "cradle" not in found[-1]

    player.listed.field.set_text("double pendulum")
    assert player.listed.matching_levels[0].title == "Double pendulum"
    player.listed.field.set_text("pendulum double")
    assert player.listed.matching_levels[0].title == "Double pendulum"


def test_what_is_not_sought_is_hidden(player: Person) -> None:
    other = player.listed.button(level_catalog.find("kinematics/free-fall"))
    assert shown(other)

    player.press(pygame.K_SLASH, "/")
    player.type("pendulum")

    assert not shown(other)
    assert shown(player.listed.button(level_catalog.find("lagrange/simple-pendulum")))


def shown(button: UIElement) -> bool:
    return bool(button.alive() and button.visible)  # type: ignore[no-untyped-call]


def test_enter_opens_the_first_that_is_found_and_leaves_the_field(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("resonance")
    player.press(pygame.K_RETURN)

    assert player.session.level.title == player.listed.matching_levels[0].title
    player.press(pygame.K_SPACE, " ")
    assert player.session.playing


def test_escape_shows_all_again_and_does_not_quit(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("skater")
    assert len(titles(player)) < 10

    player.press(pygame.K_ESCAPE)

    assert len(player.listed.matching_levels) == len(level_catalog.names())
    assert player.window.open


def test_escape_ends_a_search_that_has_been_left_before_it_quits(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("skater")
    player.press(pygame.K_RETURN)
    assert len(titles(player)) < 10

    player.press(pygame.K_ESCAPE)

    assert len(player.listed.matching_levels) == len(level_catalog.names())
    player.press(pygame.K_ESCAPE)
    assert player.window.open
    player.press(pygame.K_ESCAPE)
    assert not player.window.open


def test_what_is_sought_stays_while_levels_and_sizes_change(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("orbit")
    found = titles(player)

    player.click(player.listed.button(player.listed.matching_levels[1].path).rect)
    assert titles(player) == found

    player.press(pygame.K_l, "l")
    player.press(pygame.K_l, "l")
    assert titles(player) == found


def at_home(player: Person) -> bool:
    return player.window.panels.home.open


def test_the_way_home_shows_all_levels_again_not_what_was_sought_before(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("cradle")
    player.press(pygame.K_RETURN)
    assert not at_home(player)

    player.click(player.listed.link_button("home").rect)
    assert at_home(player)
    assert len(player.listed.matching_levels) == len(level_catalog.names())

    player.press(pygame.K_SLASH, "/")
    player.type("orbit")
    player.click(player.listed.link_button("home").rect)
    assert at_home(player)
    assert len(player.listed.matching_levels) == len(level_catalog.names())
    player.click(player.listed.link_button("home").rect)
    assert not at_home(player)


def test_what_is_typed_after_the_key_of_the_search_takes_the_place_of_what_was_sought(
    player: Person,
) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("helix")
    player.press(pygame.K_RETURN)
    player.press(pygame.K_SLASH, "/")
    player.type("skater")

    assert player.listed.search_text == "skater"


def test_where_no_level_has_all_words_those_with_most_of_them_are_found(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("fastest curved ramp")

    titles = [entry.title for entry in player.listed.matching_levels]
    assert titles[0] == "Ball down a curved ramp"
    assert all("curved" in e.words and "ramp" in e.words for e in player.listed.matching_levels)


def test_nonsense_finds_nothing_and_says_so(player: Person) -> None:
    before = player.window.surface.copy()
    player.press(pygame.K_SLASH, "/")
    player.type("xyzzy")
    player.press(pygame.K_RETURN)

    assert player.listed.matching_levels == []
    assert player.session.level.title == "Atwood machine"
    area = pygame.Rect(10, 45, 200, 30)
    after = player.window.surface
    assert before.subsurface(area).get_buffer().raw != after.subsurface(area).get_buffer().raw


def hovered(row: Row) -> bool:
    return bool(row.hovered)


def in_sight(row: Row) -> bool:
    return row.in_sight


def test_a_row_that_is_scrolled_into_sight_is_as_lively_as_those_before(player: Person) -> None:
    """It changes under the mouse, and opens its level."""
    path = level_catalog.find(level_catalog.names()[-1]).resolve()
    row = player.listed.button(path)
    assert isinstance(row, Row)
    assert not in_sight(row)

    player.listed.choose(path)
    player.listed.choose(None)
    player.wait(0.1)
    assert in_sight(row)
    apart = player.color_at((row.rect.x + 4, row.rect.centery))
    player.move(row.rect.center)
    player.wait(0.5)

    assert hovered(row)
    assert player.color_at((row.rect.x + 4, row.rect.centery)) != apart
    player.move((640, 400))
    player.wait(0.5)
    assert not hovered(row)
    assert player.color_at((row.rect.x + 4, row.rect.centery)) == apart
    player.click(row.rect)
    player.wait()
    assert player.window.path == path


def test_a_row_that_is_scrolled_away_from_the_mouse_is_left(player: Person) -> None:
    rows = player.listed
    seen = [row for row in rows.rows.values() if row.in_sight]
    player.move(seen[3].rect.center)
    player.wait(0.1)
    assert hovered(seen[3])

    rows.choose(level_catalog.find(level_catalog.names()[-1]).resolve())
    player.wait(0.1)

    assert not hovered(seen[3])
    assert not in_sight(seen[3])


def test_a_row_is_made_when_it_comes_into_sight(player: Person) -> None:
    rows, last = player.listed, level_catalog.find(level_catalog.names()[-1]).resolve()
    made = [level.path for level in rows.rows]
    assert 5 < len(made) < 60
    assert last not in made

    rows.choose(last)
    player.wait(0.1)

    (row,) = (row for level, row in rows.rows.items() if level.path == last)
    assert in_sight(row)


@pytest.mark.parametrize("direction", [1, -1])
def test_the_keyboard_gets_to_every_row_and_few_are_there_at_a_time(
    player: Person, direction: int
) -> None:
    panels, rows = player.window.panels, player.listed
    visited, most = dict[str, None](), 0

    for _ in range(len(level_catalog.names()) + 60):
        panels.move_focus(direction)
        player.wait()
        at = panels.focus.element(panels.manager, panels.layout)
        visited |= {level.title: None for level, row in rows.rows.items() if row is at}
        most = max(most, len(rows.rows))

    assert list(visited) == [level.title for level in rows.matching_levels][::direction]
    assert most < 90


def test_rows_that_are_far_out_of_sight_are_dropped(player: Person) -> None:
    rows = player.listed
    begun = len(rows.rows)

    for name in level_catalog.names():
        rows.choose(level_catalog.find(name).resolve())
        player.wait()

    assert len(rows.rows) < 4 * begun
    assert len({row.rect.y for row in rows.rows.values()}) == len(rows.rows)


def test_where_a_search_ends_the_level_that_is_played_is_in_view(player: Person) -> None:
    player.press(pygame.K_SLASH, "/")
    player.type("cradle")
    player.press(pygame.K_RETURN)
    player.press(pygame.K_ESCAPE)
    player.wait(0.1)

    shown = player.listed
    assert shown.search_text == ""
    assert player.window.path is not None
    row = shown.button(player.window.path).rect
    assert player.window.panels.layout.levels.contains(row)
