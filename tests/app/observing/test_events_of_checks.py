"""Events that have happened are marked at their places."""

import pygame
import pytest

from sandbox.app.cards.checks import checks
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.person import Person


@pytest.fixture
def thrown() -> Session:
    """Return the chapter's projectile: 25 m/s, 45°, apex 15.93 m after 1.80 s, range 63.71 m."""
    return Session(load(level_catalog.find("kinematics/projectile")))


def run(session: Session, seconds: float) -> None:
    for _ in range(round(seconds / session.world.dt)):
        session.step()


def test_nothing_is_marked_before_it_has_happened(thrown: Session) -> None:
    assert thrown.milestones() == ()
    run(thrown, 1.7)
    assert thrown.milestones() == ()


def test_the_apex_and_the_landing_are_marked_between_the_steps(thrown: Session) -> None:
    run(thrown, 1.9)
    [apex] = thrown.milestones()
    run(thrown, 1.75)
    landing = thrown.milestones()[1]

    assert apex.place == pytest.approx((31.8552, 15.9276), abs=1e-4)  # v² / 2 g, v² / 4 g
    assert apex.texts(str) == ["apex 15.9 m"]
    assert landing.place == pytest.approx((63.7105, 0), abs=1e-4)
    assert landing.texts(str) == ["range 63.7 m", "time of flight 3.60 s"]
    assert apex.passed
    assert landing.passed


def test_a_waiting_check_tells_the_value_of_now_and_what_to_expect(thrown: Session) -> None:
    run(thrown, 1.0)
    apex = next(r for r in thrown.readings() if r.result.check.label == "apex")

    assert apex.result.verdict == "waiting"
    assert apex.measured == pytest.approx(12.7727, abs=1e-4)
    assert apex.expected == pytest.approx(15.9276, abs=1e-4)


def test_what_depends_on_when_it_happens_is_not_known_before(pen: Pen) -> None:
    late = {"quantity": "ball.speed", "formula": "g*t", "tolerance": 1e-9, "at": 0.5}
    landing = {**late, "at": {"event": "landing", "body": "ball", "height": 2}}
    session = Session(scenes.level(checks=[late, landing]))

    at_time, at_event = session.readings()

    assert (at_time.measured, at_time.expected) == (0, 5)
    assert (at_event.measured, at_event.expected) == (0, None)
    assert checks(pen, 300, session.readings()).width == 300


@pytest.mark.parametrize(
    ("at", "body"),
    [
        ({"event": "crossing", "quantity": "ball.speed", "value": 5}, True),
        ({"event": "crossing", "quantity": "system.kinetic_energy", "value": 5}, False),
        (0.5, False),
    ],
)
def test_only_what_happens_to_a_body_has_a_place(at: object, body: bool) -> None:
    check = {"quantity": "ball.speed", "formula": 5, "tolerance": 1, "at": at}
    session = Session(scenes.level(checks=[check]))
    run(session, 0.8)

    places = [milestone.place for milestone in session.milestones()]

    assert places == ([pytest.approx((0, 3.75))] if body else [])  # 5 m − v² / 2 g


def test_a_contact_is_marked_on_the_body_that_moves() -> None:
    session = Session(load(level_catalog.find("momentum/bouncing-ball")))
    run(session, session.duration)

    assert {milestone.body for milestone in session.milestones()} == {"ball"}


def test_what_failed_is_marked_as_failed() -> None:
    wrong = {
        "quantity": "ball.speed", "formula": 7, "tolerance": 1e-3,
        "at": {"event": "landing", "body": "ball", "height": 2},
    }  # fmt: skip
    session = Session(scenes.level(checks=[wrong]))
    run(session, 1)

    assert [milestone.passed for milestone in session.milestones()] == [False]


@pytest.mark.sweep
def test_the_mark_is_seen_and_goes_with_a_restart(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_SPACE, " ")
    while person.session.t < 2.5:  # the apex is at 1.8 s
        person.wait()
    person.press(pygame.K_SPACE, " ")  # while time runs, a slow machine looks at a run less often
    person.wait()
    x, y = person.on_screen((31.8552, 15.9276))

    def marks() -> int:
        around = ((x + i, y + j) for i in range(-8, 9) for j in range(-8, 9))
        return sum(person.color_at(pixel) == theme.PASSED for pixel in around)

    assert marks() > 10
    person.press(pygame.K_r, "r")
    assert marks() == 0


def test_a_run_that_a_hand_has_touched_marks_nothing(thrown: Session) -> None:
    run(thrown, 2.0)
    thrown.grab("ball", (0, 0))
    thrown.drag((1, 1))

    assert thrown.milestones() == ()
