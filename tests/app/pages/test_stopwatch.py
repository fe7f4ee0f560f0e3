"""A stopwatch in the run's time: by hand, by events, and however a step is reached."""

from math import sqrt

import pygame
import pytest

from sandbox.app.pages.table.panel import TablePage
from sandbox.app.pages.table.stopwatch import Reading, Stopwatch
from sandbox.app.pages.table.stopwatch_triggers import (
    AT_ONCE,
    BY_HAND,
    Moment,
    StopwatchTrigger,
    TriggerTime,
    find,
    triggers,
)
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.expressions import Expression
from sandbox.model.level import ApexEvent, CrossingEvent
from sandbox.model.loading import load
from tests.app.person import Person
from tests.app.test_time_travel import go_to

G, V = 9.81, 25 / sqrt(2)  # m/s², m/s: of the projectile's level


def opened(name: str) -> tuple[Session, Stopwatch]:
    session, stopwatch = Session(load(level_catalog.find(name))), Stopwatch()
    stopwatch.follow(session, 0.0, watched=False)
    return session, stopwatch


def called(session: Session, told: str) -> StopwatchTrigger:
    return next(each for each in triggers(session) if each.label == told)


def reading(person: Person) -> Reading:
    return person.window.workers.of(Stopwatch).reading(person.session)


def to_the_end(session: Session) -> None:
    while session.world.steps < session.end:
        session.step()


def test_from_the_start_to_the_apex_it_takes_v_sin_over_g() -> None:
    session, stopwatch = opened("kinematics/projectile")
    stopwatch.choose(AT_ONCE, called(session, "apex of ball"))
    assert stopwatch.reading(session).is_running
    to_the_end(session)

    found = stopwatch.reading(session)

    assert not found.is_running
    assert found.seconds == pytest.approx(V / G, rel=1e-9)
    assert found.text == f"{V / G:.4f} s"


def test_bodies_have_their_names_in_words() -> None:
    session, _ = opened("machines/ragdoll")
    labels = [each.label for each in triggers(session)]

    assert "apex of left thigh" in labels
    assert not any("_" in label for label in labels)


def test_what_a_hand_starts_is_known_to_a_step_and_what_events_do_to_more() -> None:
    session, stopwatch = opened("kinematics/projectile")
    falls = called(session, "ball falls to y = 0 m")
    stopwatch.choose(called(session, "apex of ball"), falls)
    to_the_end(session)
    session.step()
    assert stopwatch.reading(session).text == f"{V / G:.4f} s"
    go_to(session, 0)
    stopwatch.choose(BY_HAND, falls)
    stopwatch.press(session)
    to_the_end(session)
    session.step()
    assert stopwatch.reading(session).text == f"{2 * V / G:.2f} s"


def test_the_first_contact_stops_it_when_the_ball_has_fallen() -> None:
    session, stopwatch = opened("momentum/bouncing-ball")
    to_the_end(session)
    stopwatch.choose(AT_ONCE, called(session, "ball meets ground"))

    found = stopwatch.reading(session)

    assert found.seconds == pytest.approx(sqrt(2 * 3 / G), rel=1e-12)
    assert found.text == "0.7821 s"
    assert not found.is_running


def test_a_hand_that_lifts_a_ball_does_not_keep_its_first_contact_from_being_timed() -> None:
    session, stopwatch = opened("momentum/bouncing-ball")
    session.grab("ball", (0.0, 3.0))
    session.drag((0.0, 2.0))
    session.release()
    assert session.world.disturbed
    to_the_end(session)

    stopwatch.choose(AT_ONCE, called(session, "ball meets ground"))

    assert 0 < stopwatch.reading(session).seconds < session.duration


def test_what_a_changed_run_lacks_has_not_happened() -> None:
    """A body was added and removed again; drawing it used to end the window."""
    session, _ = opened("newton/incline")
    session.step()
    gone: list[Moment] = [
        ApexEvent(event="apex", body="probe"),
        CrossingEvent(event="crossing", quantity="t", value=Expression("2*F")),
    ]

    assert [find(at, session.run) for at in gone] == [None, None]


def test_at_a_step_it_shows_the_same_whatever_way_led_there() -> None:
    session, stopwatch = opened("kinematics/projectile")
    stopwatch.choose(AT_ONCE, called(session, "apex of ball"))
    seen = {}
    for _ in range(150):
        session.step()
        seen[session.world.steps] = stopwatch.reading(session)

    for step in (120, 30, 60, 149, 107, 108, 109):
        go_to(session, step)
        assert stopwatch.reading(session) == seen[step], step


@pytest.mark.sweep
def test_the_key_starts_stops_and_starts_it_anew(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.wait()
    before = pygame.image.tobytes(person.window.surface, "RGB")
    stopwatch = person.window.workers.of(Stopwatch)
    assert not stopwatch.shown
    person.press(pygame.K_RIGHT)

    person.press(pygame.K_3, "3")
    assert reading(person) == Reading(0.0, 2, has_started=True, is_running=True)
    for _ in range(30):
        person.press(pygame.K_RIGHT)
    assert reading(person).text == "0.50 s"
    person.press(pygame.K_3, "3")
    for _ in range(6):
        person.press(pygame.K_RIGHT)
    assert reading(person).text == "0.50 s"
    assert not reading(person).is_running
    assert pygame.image.tobytes(person.window.surface, "RGB") != before

    go_to(person.session, 16)
    assert reading(person).text == "0.25 s"
    go_to(person.session, 0)
    assert not reading(person).has_started
    person.press(pygame.K_3, "3")
    assert reading(person).is_running

    person.press(pygame.K_ESCAPE)
    assert not stopwatch.shown
    assert person.window.open


def test_on_the_page_events_are_chosen_from_lists_and_it_is_set_back(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    for _ in range(6):
        person.press(pygame.K_RIGHT)
    person.press(pygame.K_1, "1")
    person.window.panels.scroll_pages(9)
    timing, stopwatch = person.page(TablePage).timing, person.window.workers.of(Stopwatch)
    person.wait()

    person.click(_row(timing.starts, 1))
    person.wait(0.1)
    assert (stopwatch.starts, stopwatch.stops) == (AT_ONCE, BY_HAND)
    assert reading(person).text == "0.10 s"
    person.click(timing.press.rect)
    person.press(pygame.K_RIGHT)
    assert reading(person).text == "0.10 s"
    person.click(timing.reset.rect)
    assert reading(person).is_running

    person.click(_row(timing.stops, 2))
    person.wait(0.1)
    assert stopwatch.stops.label == "apex of ball"
    person.press(pygame.K_3, "3")  # nothing is left to a hand
    assert reading(person).is_running


def _row(chooser: object, index: int) -> pygame.Rect:
    row = chooser.item_list_container.elements[index]  # type: ignore[attr-defined]
    return pygame.Rect(row.rect)


def test_another_level_puts_it_away(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_3, "3")
    assert person.window.workers.of(Stopwatch).shown

    person.window.open_level("momentum/bouncing-ball")
    person.wait()

    assert not person.window.workers.of(Stopwatch).shown


def test_what_has_not_happened_is_looked_for_once_a_step(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Searching the states of a long run takes up to half a millisecond."""
    person.window.open_level("kinematics/projectile")
    person.wait()
    person.press(pygame.K_1, "1")
    watch = person.window.workers.of(Stopwatch)
    looked: list[int] = []
    watch.choose(AT_ONCE, called(person.session, "apex of ball"))

    def search(at: Moment, run: LiveRun) -> TriggerTime | None:
        looked.append(run.world.steps)
        return find(at, run)

    monkeypatch.setattr("sandbox.app.pages.table.stopwatch.find", search)
    person.press(pygame.K_PERIOD, ".")
    person.wait(0.2)

    assert looked == [1, 1]  # for what starts it, and for what stops it
