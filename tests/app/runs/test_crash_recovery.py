"""A run that was not saved survives the window that played it, with all that the user did."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from math import inf
from pathlib import Path

import pygame
import pytest

from sandbox.app import main
from sandbox.app.home import unfinished_work_strip
from sandbox.app.runs import crash_recovery, run_file
from sandbox.app.runs import session as sessions
from sandbox.app.runs.crash_recovery import OFTEN, LeftRun, RunRecovery, left_runs
from sandbox.app.runs.session import Session
from sandbox.model import atomic_file_writing, unsaved_files
from tests.app.person import Person, until
from tests.app.runs.test_run_file import pulled
from tests.app.scenes import opened
from tests.elsewhere import limited


def played() -> Session:
    """Return a run with another parameter, a pull and a branch."""
    session = opened("newton/atwood", 0)
    session.restart({"m1": 3.0})
    session.do_again((), 20)
    pulled(session)
    session.branch({"m2": 2.5})
    session.do_again(session.run.script, 60)
    return session


def crash() -> None:
    """Treat what is kept as left by a process that has ended."""
    unsaved_files._OPEN.clear()


def left_by(session: Session) -> LeftRun:
    """Return what is found of a run after a crash."""
    assert RunRecovery().follow(session, OFTEN) == ""
    crash()
    (found,) = left_runs(3)
    return found


def test_a_run_that_was_lost_goes_on_where_it_was_to_the_last_bit(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sessions, "AT_ONCE", inf)  # a busy machine takes several frames
    session = played()

    again = left_by(session).session()

    assert (again.world.steps, again.values) == (60, session.values)
    assert list(again.all_actions) == list(session.all_actions)
    assert run_file.fingerprint(again.world.snapshot) == run_file.fingerprint(
        session.world.snapshot
    )
    assert not again.playing
    assert not again.repeats  # its challenge may still be won


def test_a_run_from_a_file_that_was_lost_still_earns_no_stars() -> None:
    session = played()
    session.repeats = True

    assert left_by(session).session().repeats


def test_what_nobody_would_miss_is_not_kept(tmp_path: Path) -> None:
    kept, session = RunRecovery(), opened("newton/atwood", 0)
    kept.follow(session, OFTEN)
    assert not list(tmp_path.rglob("*.run.json"))

    session.step()
    kept.follow(session, OFTEN)
    (file,) = tmp_path.rglob("*.run.json")
    written = file.stat().st_mtime_ns
    kept.follow(session, 60.0)
    assert file.stat().st_mtime_ns == written  # nothing has happened since

    kept.delete()
    assert not list(tmp_path.rglob("*.run.json"))


def test_the_run_of_another_window_is_left_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    assert RunRecovery().follow(played(), OFTEN) == ""
    assert not left_runs(3)  # its window is this process
    crash()
    monkeypatch.setattr(os, "getpid", lambda: 1)
    assert not left_runs(3)  # nor has the process ended


def test_where_nothing_can_be_kept_that_is_told_once(tmp_path: Path) -> None:
    (tmp_path / "runs").write_text("a file", "utf-8")
    kept, session = RunRecovery(), played()
    assert "it is a file" in kept.follow(session, OFTEN)
    session.step()
    assert kept.follow(session, 60.0) == ""


def test_what_another_program_has_put_there_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "runs").mkdir()
    for name in ("x.run.json", f"{'0' * 32}.run.json", f"{10**9}-{'0' * 32}.run.json"):
        (tmp_path / "runs" / name).write_text("{", "utf-8")
    assert not left_runs(3)


def test_a_lost_run_is_offered_above_the_cards_and_gone_on_with(person: Person) -> None:
    session = played()
    left_by(session)
    person.window.open_level("kinematics/free-fall")
    person.press(pygame.K_F2)
    (left,) = left_runs(3)
    assert unfinished_work_strip.summary(left).startswith("Not saved: the run of Atwood machine, ")

    person.click(person.window.panels.home.strip.rect_of(0))
    until(person, lambda: person.session.level.title == "Atwood machine")
    until(person, lambda: person.session.sought is None)  # computing it takes some frames

    assert not person.window.panels.home.open
    assert person.session.world.steps == 60
    assert person.window.recovery.follow(person.session, 0.0) == ""
    assert not left.file.exists()  # it is this window's own now
    crash()
    assert len(left_runs(3)) == 1


def test_a_window_on_a_level_tells_of_a_lost_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """`play LEVEL` does not show the home page, which offers it."""
    left_by(played())
    monkeypatch.setattr(pygame, "quit", lambda: None)

    with main._opened("kinematics/free-fall", None, None, False) as window:
        note = window.banner._note

    assert note.startswith("Not saved when a window ended: Atwood machine, ")


PLAYS = """
    import sys
    from pathlib import Path
    from sandbox.app.runs import crash_recovery
    from sandbox.app.window import Window
    crash_recovery.data_folder = lambda: Path(sys.argv[1])
    window = Window()
    window.open_level("newton/atwood")
    session = window.session
    session.change({"m1": 2.0})
    session.toggle()
    for number, _ in enumerate(window.pictures()):
        if number % 7 == 3:
            session.grab("left", tuple(map(float, session.world.snapshot.position[0])))
            session.drag((-0.5, 0.01 * (number % 50)))
        if number % 7 == 5:
            session.release()
        session.playing = True
        print(session.world.steps, len(session.all_actions), flush=True)
        if sys.argv[2:] and session.world.steps > 30:
            window.open = False
"""


def plays(folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """Start a window in another process, which prints the steps and actions of its run."""
    command = [sys.executable, "-c", limited() + textwrap.dedent(PLAYS), str(folder), *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


@pytest.mark.sweep
@pytest.mark.skipif(sys.platform == "win32", reason="has no signal that ends a process at once")
def test_a_window_killed_at_any_moment_loses_no_more_than_a_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Killed 8 times, each a little later: the run is whole, and lacks its last moments at most."""
    monkeypatch.setattr(crash_recovery, "folder", lambda: tmp_path / "runs")
    for late in range(8):
        with plays(tmp_path) as window:
            assert window.stdout is not None
            first = window.stdout.readline()
            while not list(tmp_path.rglob("*.run.json")):
                first = window.stdout.readline()
            time.sleep(0.4 * late)
            window.send_signal(signal.SIGKILL)
            steps, actions = map(int, (first + window.stdout.read()).splitlines()[-1].split())
        (left,) = left_runs(3)
        again = left.session()
        again.do_again(again.run.script, left.run.steps)
        assert steps - left.run.steps <= 2 * OFTEN * again.world.stepping.rate
        assert 0 < len(left.run.actions) <= actions
        assert run_file.is_same(left.run, again)
        # sweeps what was half written
        atomic_file_writing.write_atomically(tmp_path / "beside.json", "")
        left.file.unlink()


@pytest.mark.sweep
def test_a_window_that_is_closed_leaves_no_run(tmp_path: Path) -> None:
    with plays(tmp_path, "and closes") as window:
        assert window.wait() == 0
    assert not list(tmp_path.rglob("*.run.json"))
