"""Edits of a run are undone, by real events."""

from pathlib import Path

import pygame
import pytest

from sandbox.app.pages.effects import switching_effects
from sandbox.app.pages.scheme_race import scheme_comparison
from tests.app.person import Person
from tests.app.scenes import falling

CONTROL = pygame.KMOD_LCTRL


def undo(person: Person) -> None:
    person.press(pygame.K_z, "\x1a", CONTROL)


def redo(person: Person) -> None:
    person.press(pygame.K_y, "\x19", CONTROL)


def g(person: Person) -> float:
    return float(person.session.values["g"])


@pytest.mark.sweep
def test_a_parameter_is_taken_back_and_set_again(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.set_to("g", "5")
    person.set_to("g", "7")
    undo(person)
    assert g(person) == 5
    assert "g is 5" in person.window.banner._note
    undo(person)
    assert g(person) == 10
    undo(person)
    assert "nothing to undo" in person.window.banner._note
    redo(person)
    redo(person)
    assert g(person) == 7
    redo(person)
    assert "nothing to redo" in person.window.banner._note


def test_what_is_changed_after_an_undo_takes_the_place_of_what_was_undone(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    person.set_to("g", "5")
    undo(person)
    person.set_to("g", "8")
    redo(person)
    assert g(person) == 8
    undo(person)
    assert g(person) == 10


def test_a_slider_that_is_dragged_is_one_change(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    side = person.side
    knob = side.parameters.row("g").slider.sliding_button
    assert knob is not None
    start = knob.rect.center
    person.drag(start, (start[0] + 60, start[1]))
    person.wait(1.0)
    assert g(person) > 10
    undo(person)
    assert g(person) == 10


def test_speed_effects_and_race_are_taken_back_in_their_order(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    session = person.session
    person.press(pygame.K_PLUS, "+")
    person.wait(1.0)
    switching_effects.toggle(session, "gravity")
    person.wait(1.0)
    scheme_comparison.toggle(session)
    person.wait(1.0)

    undo(person)
    assert not scheme_comparison.racing(session)
    assert session.changes
    undo(person)
    assert not session.changes
    assert session.level is session.original
    assert session.speed == 2
    undo(person)
    assert session.speed == 1
    for _ in range(3):
        redo(person)
    assert scheme_comparison.racing(session)
    assert session.speed == 2


def test_another_rate_is_taken_back(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    before = person.session.world.stepping.rate
    person.session.rerun(240.0)
    person.session.pause()
    person.wait(1.0)
    assert person.session.world.stepping.rate == 240
    undo(person)
    assert person.session.world.stepping.rate == before


def test_a_change_on_the_way_is_taken_back_to_the_step_where_it_was_made(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    session = person.session
    for _ in range(20):
        session.step()
    person.wait()
    here = session.world.snapshot.position.copy()
    session.branch({"g": 4.0})
    person.wait()
    for _ in range(5):
        session.step()
    person.wait(1.0)

    undo(person)
    assert g(person) == 10
    assert session.world.steps == 20
    assert (session.world.snapshot.position == here).all()
    redo(person)
    assert g(person) == 4
    assert session.world.steps == 20


def test_a_way_back_in_time_is_no_change(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.set_to("g", "5")
    for _ in range(20):
        person.session.step()
    person.session.branch({"g": 4.0})
    person.wait(1.0)
    person.session.go_to(3)
    person.wait(1.0)
    assert g(person) == 5
    person.press(pygame.K_r, "r")
    person.wait(1.0)
    undo(person)
    undo(person)
    assert g(person) == 10


def test_another_level_has_nothing_to_be_taken_back(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.set_to("g", "5")
    person.open(tmp_path, falling(title="Another"))
    undo(person)
    assert g(person) == 10
    assert "nothing to undo" in person.window.banner._note


def test_the_editor_keeps_an_undo_of_its_own(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.press(pygame.K_PLUS, "+")
    person.window.do("build page")
    person.wait(1.0)
    undo(person)
    assert person.session.speed == 2


def test_a_branch_is_taken_back_and_made_again_where_the_run_still_stands_at_it(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    person.session.do_again((), 20)
    person.press(pygame.K_o, "O", pygame.KMOD_SHIFT)
    person.set_to("g", "12")
    person.set_to("g", "14")
    assert (g(person), person.session.world.steps) == (14, 20)

    for key, expected in ((undo, 12), (undo, 10), (redo, 12), (redo, 14)):
        key(person)
        person.wait(0.2)
        assert (g(person), person.session.world.steps) == (expected, 20)
