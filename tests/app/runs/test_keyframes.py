"""Keyframes: a run goes back and ahead without being computed from its start."""

import numpy as np
import pytest

from sandbox.app.runs import keyframes, run_player
from sandbox.app.runs.keyframes import Keyframes
from sandbox.app.runs.session import Session
from sandbox.app.runs.step_timer import StepTimer
from sandbox.model.errors import SandboxError
from sandbox.physics.stepping.world import World
from tests.app.scenes import opened
from tests.app.test_time_travel import go_to
from tests.levels.playing import fingerprint


@pytest.fixture(autouse=True)
def _at_every_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keyframes, "SPACING", 0.0)  # s
    monkeypatch.setattr(keyframes, "SHARE", 1e9)


def run(name: str, steps: int) -> Session:
    """Return a run after some steps."""
    session = opened(name)
    for _ in range(steps):
        session.step()
    return session


def at_once(session: Session, step: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Go to a step, if that takes no step of computing."""
    monkeypatch.setattr(run_player, "AT_ONCE", -1.0)  # s
    session.go_to(step)
    assert session.world.steps == step
    session.update(0.0)


@pytest.mark.parametrize("name", ["newton/atwood", "energy/kepler-ellipse", "energy/refrigerator"])
def test_all_that_was_observed_is_as_in_a_run_that_was_never_longer(name: str) -> None:
    session, alone = run(name, 50), run(name, 20)

    for step in (10, 40, 20):
        go_to(session, step)

    assert fingerprint(session.world.snapshot) == fingerprint(alone.world.snapshot)
    for column, values in alone.trace.columns.items():
        assert np.array_equal(session.trace.columns[column], values)
    assert session.trace.meetings == alone.trace.meetings
    assert np.array_equal(session.history.rows, alone.history.rows)
    assert np.array_equal(session.trail.points, alone.trail.points)
    assert np.array_equal(session.books.history, alone.books.history)
    assert session.readings() == alone.readings()
    assert session.run.farthest.steps() == 50


def test_a_run_goes_back_and_ahead_without_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    session = run("newton/atwood", 50)

    for step in (30, 5, 45, 50):
        at_once(session, step, monkeypatch)


def test_a_run_that_went_back_is_played_on_to_the_same_bits() -> None:
    session, alone = run("lagrange/double-pendulum", 40), run("lagrange/double-pendulum", 60)
    go_to(session, 15)

    for _ in range(45):
        session.step()

    assert fingerprint(session.world.snapshot) == fingerprint(alone.world.snapshot)
    assert len(session.trace.t) == 61


def test_another_future_does_not_use_the_keyframes_of_the_old_one() -> None:
    session = run("newton/atwood", 50)
    go_to(session, 20)
    session.branch({"m1": 3.0})
    for _ in range(10):
        session.step()
    state = fingerprint(session.world.snapshot)

    go_to(session, 25)
    go_to(session, 30)

    assert fingerprint(session.world.snapshot) == state
    assert session.values["m1"] == 3.0


def test_keyframes_are_thinned_when_they_fill_their_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    session = run("newton/atwood", 40)
    kept = session.run.keyframes
    assert len(kept) == 40

    monkeypatch.setattr(keyframes, "MEMORY", 0.0)
    session.step()

    assert len(kept) == 21
    found = kept.before(41)
    assert found
    assert found.step == 41


def test_keyframes_are_apart_by_computing_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keyframes, "SPACING", 1e9)
    assert not len(run("newton/atwood", 40).run.keyframes)


def test_contacts_leave_no_keyframes() -> None:
    assert not len(run("momentum/cradle", 20).run.keyframes)


def test_events_leave_no_keyframes() -> None:
    """What was observed before an event would show the forces and joints after it."""
    assert not len(run("machines/hammer-throw", 20).run.keyframes)


def test_a_run_that_cannot_use_its_keyframes_is_not_repeated_to_go_ahead() -> None:
    session = run("newton/atwood", 50)
    go_to(session, 10)
    session.run.books.keep(True)
    before = session.run

    go_to(session, 30)

    assert session.run is before
    assert session.world.steps == 30


def test_a_run_goes_back_from_a_step_that_was_not_observed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A step that has computed too long is taken, but ends the run."""
    session, alone = run("newton/atwood", 50), run("newton/atwood", 20)

    def fail(_timer: StepTimer, world: World, _limit: object) -> None:
        world.step()
        raise SandboxError("a step takes too long")

    with monkeypatch.context() as patched:
        patched.setattr(StepTimer, "take_step", fail)
        session.step()
    assert session.run.failure is not None
    go_to(session, 20)

    assert session.failure is None
    assert np.array_equal(session.history.rows, alone.history.rows)


def test_after_a_failure_keyframes_begin_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """So do the books of energies."""
    monkeypatch.setattr(World, "go_on", lambda _: None)
    session = run("newton/atwood", 50)
    session.run.go_on()
    for _ in range(10):
        session.step()

    assert len(session.run.keyframes) == 10
    go_to(session, 20)
    assert len(session.books.history) > 20


def test_keyframes_after_a_branch_hold_nothing_of_the_world_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = run("energy/refrigerator", 20)
    session.branch({})
    ledgers: list[object] = []
    monkeypatch.setattr(Keyframes, "note", lambda *noted: ledgers.append(noted[2]))

    session.step()

    assert ledgers == [None]
