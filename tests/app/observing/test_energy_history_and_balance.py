"""Energies of every run are recorded; their sources and losses while somebody watches."""

import numpy as np
import pygame
import pytest

from sandbox.app.runs.session import Session
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from tests.app.person import FRAME, Person
from tests.app.scenes import play
from tests.physics.scenes import GRAVITY, box, floor, level

LEVELS = (
    "energy/figure-eight",  # of fourth order
    "energy/loop",
    "hard/arch",
    "hard/hanging-cradle",
    "machines/coil-gun",
    "momentum/recoil",
    "newton/rocket",
)


def session_of(name: str, *, booked: bool = False) -> Session:
    session = Session(load(find(name)))
    session.book(booked)
    return session


def sliding() -> Session:
    block = box((0, 0.25), velocity=[3, 0], friction=0.5)
    effects = {**GRAVITY, "contact": {}, "friction": {}}
    return Session(level({"block": block, "floor": floor(friction=1)}, effects))


def kept(person: Person) -> bool:
    return person.session.books.kept


def step(session: Session, count: int) -> Session:
    for _ in range(count):
        session.step()
    return session


@pytest.mark.parametrize("name", LEVELS)
def test_a_run_is_the_same_to_the_last_bit_whether_it_is_booked_or_not(name: str) -> None:
    bare, booked = session_of(name), session_of(name, booked=True)
    late = session_of(name)
    step(late, 7).book(True)

    step(bare, 40), step(booked, 40), step(late, 33)

    assert booked.books.kept
    for other in (booked, late):
        for field in ("t", "position", "angle", "velocity", "angular_velocity", "tension"):
            now = getattr(other.world.snapshot, field)
            assert np.array_equal(getattr(bare.world.snapshot, field), now)


def test_books_that_are_opened_on_the_way_tell_what_came_since() -> None:
    """Friction takes 3 J from the block in the first half, and the rest of 4.5 J later."""
    whole, late = sliding(), sliding()
    whole.book(True)
    step(whole, 15), step(late, 15)
    lost = whole.books.balance.loss["friction"]
    late.book(True)

    step(whole, 15), step(late, 15)

    assert lost > 0.5
    found = late.books.balance
    assert found.loss["friction"] == pytest.approx(whole.books.balance.loss["friction"] - lost)
    assert abs(found.unexplained) < 1e-12
    assert late.books.covered == "since t = 0.25 s, half a step ahead"


def test_books_that_nobody_keeps_tell_of_nothing_but_now() -> None:
    session = step(sliding(), 15)

    assert not session.books.kept
    assert session.books.balance.loss["friction"] == 0
    assert session.books.balance.kinetic > 1
    assert session.books.covered == "since t = 0.25 s, half a step ahead"


def test_a_way_back_books_the_run_from_its_start() -> None:
    session = step(sliding(), 15)
    session.book(True)

    session.go_to(10)

    assert session.books.covered == "since the start, half a step ahead"
    assert session.books.balance.loss["friction"] > 0.5


def test_a_branch_is_booked_since_it_left() -> None:
    session = step(session_of("newton/incline", booked=True), 10)

    session.branch({"mass": 3.0})

    assert session.books.kept
    assert session.books.covered == f"since t = {session.t:.2f} s, half a step ahead"


def test_the_energies_of_a_run_are_those_of_its_steps() -> None:
    session, seen = session_of("machines/coil-gun"), []
    for _ in range(30):
        now = session.books.energies
        seen.append((session.t, now.kinetic, now.potential, now.total))
        session.step()

    assert session.books.history[:30] == pytest.approx(np.array(seen), rel=1e-12, abs=1e-15)


@pytest.mark.sweep
def test_steps_are_booked_only_while_a_card_tells_of_it(person: Person) -> None:
    person.window.open_level("newton/incline")
    person.press(pygame.K_SPACE, " ")
    for _ in range(5):
        person.wait(FRAME)
    assert not kept(person)

    person.press(pygame.K_m, "m")
    assert kept(person)
    assert person.session.books.since

    person.press(pygame.K_d, "d")
    assert not kept(person)

    person.press(pygame.K_e, "e")
    assert person.window.panels.energy == "bars"
    assert kept(person)

    person.press(pygame.K_r, "r")
    person.wait(FRAME)
    assert kept(person)
    assert person.session.books.since is None


def test_bars_in_a_column_that_is_hidden_book_nothing(person: Person) -> None:
    person.window.open_level("newton/incline")
    person.press(pygame.K_e, "e")
    assert kept(person)

    person.press(pygame.K_p, "p")

    assert not kept(person)


def test_a_run_to_its_end_loses_no_energies() -> None:
    session = play(session_of("kinematics/free-fall"))

    t = session.books.history[:, 0]

    assert t[0] == 0
    assert t[-1] == session.t
    assert (np.diff(t)[:-1] > 0).all()


def test_in_a_small_window_the_energy_is_folded_until_somebody_asks_for_it(person: Person) -> None:
    def view() -> str:
        assert person.side.foot is not None
        return person.side.foot.view

    person.window.open_level("momentum/cradle")
    assert view() == "graph"

    person.resize((900, 600))
    assert view() == "total"
    assert person.side.foot is not None
    person.click(person.side.foot.switch.rect)
    assert view() == "graph"
