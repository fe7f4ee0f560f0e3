"""Parts are added to a run while it plays, removed and changed; and the run is kept."""

from typing import Any

import pygame
import pytest

from sandbox.app.pages.build import mistakes_suggestions_and_effects
from sandbox.app.pages.page import Page
from sandbox.app.pages.register import PAGES
from sandbox.app.runs import run_file
from sandbox.app.runs.run_file import Run
from sandbox.model.loading import parse
from tests.app.building.builder import Builder
from tests.app.person import until
from tests.levels.playing import fingerprint


@pytest.fixture
def running(builder: Builder) -> Builder:
    """A person who watches a block slide down a slope."""
    builder.person.window.open_level("newton/incline")
    builder.key(pygame.K_b, "b")
    builder.key(pygame.K_SPACE, " ")
    builder.person.wait(0.3)
    return builder


def dropped(builder: Builder) -> Builder:
    """Drop a disc from well above the slope."""
    builder.key(pygame.K_2, "2")
    builder.drag((4, 5), (4.2, 5))
    return builder


def kinds(builder: Builder) -> list[str]:
    return [action.kind for action in builder.person.session.actions]


@pytest.mark.sweep
def test_a_disc_that_is_drawn_into_the_run_falls_with_it(running: Builder) -> None:
    session = running.person.session
    dropped(running)

    assert (kinds(running), session.playing) == (["alter"], True)
    assert list(session.level.bodies) == ["ramp", "block", "disc1"]
    assert list(running.document["bodies"]) == ["ramp", "block"]  # what is built stays
    running.person.wait(0.2)
    assert session.world.snapshot.velocity[2, 1] < -1


def test_a_body_that_is_looked_at_may_be_gone_where_the_run_begins_anew(running: Builder) -> None:
    session = running.person.session
    dropped(running)
    running.key(pygame.K_ESCAPE)
    running.at(*session.world.snapshot.position[2].tolist())
    assert session.looking.body(session.level) == "disc1"
    running.key(pygame.K_j, "j")

    running.key(pygame.K_r, "r")

    assert session.looking.body(session.level) == "block"


def test_a_click_right_after_the_run_has_begun_anew_finds_nothing_that_is_gone(
    running: Builder,
) -> None:
    person, session = running.person, running.person.session
    dropped(running)
    running.key(pygame.K_ESCAPE)
    running.key(pygame.K_j, "j")
    session.playing = False
    x, y = session.world.snapshot.position[2]
    place = person.on_screen((x, y))

    person.move(place)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_r, unicode="r", mod=0, scancode=0))
    person.button(True, place)
    person.button(False, place)
    person.wait(0.2)

    assert "disc1" not in session.level.bodies


def test_time_stands_while_something_is_drawn_and_then_goes_on(running: Builder) -> None:
    session = running.person.session
    running.key(pygame.K_2, "2")
    running.at(4, 5)
    running.person.wait(0.2)
    steps = session.world.steps
    running.person.wait(0.2)
    assert (session.world.steps, session.playing) == (steps, False)
    running.at(4.2, 5)

    assert session.playing


def test_a_pin_ties_what_was_thrown_in_to_the_plane(running: Builder) -> None:
    running.key(pygame.K_SPACE, " ")
    dropped(running)
    running.key(pygame.K_7, "7")
    running.tool("pivot")
    session = running.person.session
    place = session.world.snapshot.position[2].tolist()
    pygame.key.set_mods(pygame.KMOD_LALT)
    running.at(*place)
    pygame.key.set_mods(pygame.KMOD_NONE)
    running.key(pygame.K_SPACE, " ")
    running.person.wait(0.3)

    assert kinds(running) == ["alter", "alter"]
    assert session.world.snapshot.position[2].tolist() == pytest.approx(place, abs=1e-12)


def test_a_mass_is_set_and_a_body_taken_out_while_it_runs(running: Builder) -> None:
    session = running.person.session
    running.key(pygame.K_SPACE, " ")
    running.at(*session.world.snapshot.position[1].tolist())
    assert running.editor.bench.selected == (("bodies", "block"),)
    running.fill("7", "bodies", "block", "mass")
    assert session.level.bodies["block"].mass({}) == 7  # type: ignore[misc]
    dropped(running)
    running.key(pygame.K_ESCAPE)
    running.at(*session.world.snapshot.position[1].tolist())
    running.key(pygame.K_DELETE)

    assert list(session.level.bodies) == ["ramp", "disc1"]
    assert session.looking.body(session.level) == "disc1"


def test_a_run_that_was_changed_comes_from_its_file_to_the_last_bit(running: Builder) -> None:
    dropped(running)
    running.person.wait(0.2)
    session = running.person.session
    session.playing = False
    run = Run.model_validate_json(run_file.run_of(session).model_dump_json())

    assert run_file.is_same(run, run_file.replay(run))


def test_what_is_changed_last_is_part_of_the_file_at_once(running: Builder) -> None:
    running.key(pygame.K_SPACE, " ")
    dropped(running)
    run = run_file.run_of(running.person.session)

    assert run_file.is_same(run, run_file.replay(run))
    straight = run.model_copy(update={"actions": ()})
    assert not run_file.is_same(run, run_file.replay(straight))


def test_undo_takes_back_the_change_then_the_run_and_redo_brings_both(running: Builder) -> None:
    session, text = running.person.session, running.editor.work.draft.text
    dropped(running)
    running.person.wait(0.2)
    running.control("z")
    until(running.person, lambda: session.sought is None)
    steps = session.world.steps
    assert (steps > 0, kinds(running)) == (True, [])
    running.control("y")
    assert (session.world.steps, kinds(running)) == (steps, ["alter"])
    late = fingerprint(session.world.snapshot)
    running.control("z")
    until(running.person, lambda: session.sought is None)
    running.control("z")
    assert (session.world.steps, running.editor.work.draft.text) == (0, text)
    running.control("y")
    until(running.person, lambda: session.sought is None)
    running.control("y")

    assert fingerprint(session.world.snapshot) == late


def test_who_goes_back_to_building_can_come_back_to_the_run(running: Builder) -> None:
    session = running.person.session
    dropped(running)
    running.key(pygame.K_SPACE, " ")
    late, t = fingerprint(session.world.snapshot), session.t
    running.key(pygame.K_ESCAPE)
    running.key(pygame.K_ESCAPE)
    assert session.world.steps == 0
    running.act(f"Back to the run at {t:.2f} s")
    until(running.person, lambda: session.sought is None)

    assert fingerprint(session.world.snapshot) == late


def test_the_run_that_is_come_back_to_is_one_of_the_level_that_it_was_left_of(
    running: Builder,
) -> None:
    """Between two frames, the last edit is undone and the run before it is restored."""
    running.key(pygame.K_SPACE, " ")
    session = running.person.session
    steps, late = session.world.steps, fingerprint(session.world.snapshot)
    running.control("z")
    text = running.editor.work.draft.text
    running.at(*session.world.snapshot.position[1].tolist())
    running.key(pygame.K_UP)
    until(running.person, lambda: session.original.text == running.editor.work.draft.text != text)

    for letter in "zy":
        key = pygame.key.key_code(letter)
        said: dict[str, Any] = {"key": key, "unicode": "", "mod": pygame.KMOD_LCTRL, "scancode": 0}
        pygame.event.post(pygame.Event(pygame.KEYDOWN, **said))
    running.person.wait(0.5)
    until(running.person, lambda: session.sought is None)

    assert (session.original.text, session.world.steps) == (text, steps)
    assert fingerprint(session.world.snapshot) == late


def test_the_run_is_kept_as_a_level_that_loads_and_the_other_one_stays(running: Builder) -> None:
    before = running.editor.work.draft
    dropped(running)
    running.person.wait(0.1)
    place = running.person.session.world.snapshot.position[2].tolist()
    running.key(pygame.K_SPACE, " ")
    running.act("Keep as a level")
    running.person.wait(0.1)

    level = parse(running.editor.work.draft.text)
    assert running.person.session.world.steps == 0
    assert "disc1" in level.bodies
    x, y = level.bodies["disc1"].position
    assert (x({}), y({}) < 5) == (place[0], True)
    assert not level.checks
    assert running.editor.work.draft is not before
    assert before.text == before.saved


@pytest.mark.sweep
def test_a_drop_onto_another_body_is_refused_and_the_run_goes_on_as_it_was(
    running: Builder,
) -> None:
    session = running.person.session
    world = session.world
    running.key(pygame.K_2, "2")
    running.drag((4, 1), (4.5, 1))  # within the ramp

    assert (session.world, kinds(running), session.failure) == (world, [], None)
    assert session.playing


def test_the_page_tells_that_no_check_holds_for_a_run_that_was_changed(running: Builder) -> None:
    dropped(running)
    told = [
        block.text
        for block in mistakes_suggestions_and_effects.mistakes_and_choices(
            running.editor, running.person.session
        )
    ]
    assert mistakes_suggestions_and_effects.NO_FORMULA in told


@pytest.mark.sweep
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_page_shows_a_run_that_was_changed_and_lets_it_begin_anew(
    running: Builder, page: Page
) -> None:
    """Its parameters differ from the level's: the slope's angle has become a number."""
    session = running.person.session
    dropped(running)
    assert session.values.keys() != session.original.parameters.keys()

    running.person.window.do(page.command)
    running.person.wait(0.2)
    running.key(pygame.K_r, "r")

    assert (session.failure, session.values) == (None, session.original.defaults)
