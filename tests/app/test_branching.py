"""A run that branches: in the window, in its file, and when the branch is undone."""

from pathlib import Path

import pygame
import pytest
from pygame_gui.elements import UIButton

from sandbox.app.pages.level.panel import LevelPage
from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.parameters_changeable_in_run import obstacle
from tests.app.person import Person
from tests.app.scenes import opened
from tests.app.test_time_travel import go_to
from tests.levels.playing import fingerprint

LEVELS = level_catalog.names()[::11]


def another(session: Session) -> dict[str, float]:
    """Return another value for the first parameter that can change during a run, if any."""
    for name, parameter in session.level.parameters.items():
        if obstacle(session.level, [name]) is None:
            middle = (parameter.min + parameter.max) / 2
            value = middle if middle != session.values[name] else parameter.max
            return {name: 0.9 * session.values[name] + 0.1 * value}
    return {}


@pytest.mark.parametrize("name", LEVELS)
def test_a_branched_run_from_a_file_is_the_same_to_the_last_bit(name: str, tmp_path: Path) -> None:
    session = opened(name, 12)
    settings = another(session)
    if not settings:
        return
    session.branch(settings)
    for _ in range(12):
        session.step()
    assert session.failure is None
    run_file.save(run_file.run_of(session), tmp_path / "run.json")

    run = run_file.read(tmp_path / "run.json")

    assert run_file.is_same(run, run_file.replay(run))
    straight = run.model_copy(update={"actions": ()})
    assert run_file.replay(straight).values != session.values


def test_the_way_back_over_a_branch_leads_into_the_old_run_and_forgets_the_branch() -> None:
    session = opened("kinematics/projectile", 10)
    early = fingerprint(session.world.snapshot)
    for _ in range(10):
        session.step()
    session.branch({"g": 3.0})
    for _ in range(20):
        session.step()
    late = fingerprint(session.world.snapshot)

    go_to(session, 40)
    assert (fingerprint(session.world.snapshot), session.values["g"]) == (late, 3.0)
    go_to(session, 30)
    go_to(session, 40)
    assert fingerprint(session.world.snapshot) == late

    go_to(session, 10)
    assert fingerprint(session.world.snapshot) == early
    assert (session.values["g"], session.actions) == (9.81, [])


def test_the_old_run_stays_as_far_as_it_had_come_before_the_way_back() -> None:
    session = opened("kinematics/projectile", 60)
    go_to(session, 20)

    session.branch({"g": 3.0})

    assert [run.label(session.values) for run in session.earlier] == ["g = 9.81, left at 0.33 s"]
    assert len(session.earlier[0].trail) == 61


def test_a_slider_that_is_dragged_while_time_stands_leaves_one_branch() -> None:
    session = opened("kinematics/projectile", 20)
    once = opened("kinematics/projectile", 20)
    for g in (8.0, 5.0, 3.0):
        session.branch({"g": g})
    once.branch({"g": 3.0})
    for each in (session, once):
        for _ in range(10):
            each.step()

    assert session.actions == once.actions
    assert len(session.earlier) == 1
    assert fingerprint(session.world.snapshot) == fingerprint(once.world.snapshot)


def test_what_cannot_be_changed_on_the_way_leaves_the_run_as_it_was() -> None:
    session = opened("kinematics/projectile", 20)
    world = session.world

    with pytest.raises(SandboxError, match="only its start or what is displayed"):
        session.branch({"speed": 12.0})

    assert session.world is world
    assert (session.failure, session.earlier, session.actions) == (None, (), [])


def test_at_the_start_there_is_nothing_to_branch_from() -> None:
    session = opened("kinematics/projectile", 0)
    session.branch({"speed": 12.0})
    assert (session.values["speed"], session.actions) == (12.0, [])


def test_a_branched_run_is_held_against_no_formula() -> None:
    session = opened("kinematics/projectile", 20)
    session.branch({"g": 3.0})
    assert session.world.disturbed
    assert session.milestones() == ()


def drag(person: Person, name: str, by: int) -> None:
    knob = person.side.parameters.row(name).slider.sliding_button
    assert knob is not None
    x, y = knob.rect.center
    person.drag((x, y), (x + by, y))
    person.wait()


def switch(person: Person) -> UIButton:
    page = person.page(LevelPage)
    assert page.onwards is not None
    return page.onwards


@pytest.mark.sweep
def test_shift_and_the_switch_decide_where_a_change_acts_from(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.5)
    person.press(pygame.K_SPACE, " ")
    steps = person.session.world.steps
    assert steps > 0

    monkeypatch.setattr(pygame.key, "get_mods", lambda: pygame.KMOD_SHIFT)
    drag(person, "g", -40)
    assert [action.kind for action in person.session.actions] == ["branch"]
    assert person.session.world.steps == steps
    monkeypatch.undo()

    person.press(pygame.K_o, "O", pygame.KMOD_SHIFT)
    assert person.session.branches
    drag(person, "g", 30)
    assert person.session.world.steps == steps

    person.click(switch(person).rect)
    drag(person, "g", -30)
    assert person.session.world.steps == 0


def test_what_cannot_be_changed_on_the_way_is_told_beside_its_slider(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    for _ in range(5):
        person.press(pygame.K_RIGHT)
    person.session.branches = True
    drag(person, "speed", -40)

    assert "only its start or what is displayed" in person.side.parameters.refusal
    assert person.session.world.steps == 5
    assert person.session.values["speed"] == 25


def test_a_body_put_elsewhere_between_two_branches_stays_there() -> None:
    session = opened("kinematics/projectile", 20)
    session.branch({"g": 5.0})
    session.grab("ball", (0.0, 0.0))
    session.drag((1.0, 1.0))
    session.release()
    placed = session.world.snapshot.position.copy()
    session.branch({"g": 3.0})

    assert [action.kind for action in session.actions] == ["branch", "place", "branch"]
    assert session.world.snapshot.position.tolist() == placed.tolist()
