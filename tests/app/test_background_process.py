"""Work in another process."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import pytest

from sandbox import interrupts
from sandbox.app.background_process import Background
from tests.app import work
from tests.elsewhere import limited
from tests.patience import alive

PATIENCE = 60.0  # s


@pytest.fixture
def background() -> Iterator[Background]:
    found = Background()
    yield found
    found.cancel()


def until(true: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def findings(background: Background) -> list[object]:
    found: list[object] = []
    until(lambda: found.extend(background.results()) or not background.running)  # type: ignore[func-returns-value]
    return found


@pytest.mark.sweep
def test_findings_come_in_one_by_one_until_the_work_is_done(background: Background) -> None:
    background.start(work.count, 5)

    assert background.running
    assert findings(background) == [0, 1, 2, 3, 4]
    assert not background.running


@pytest.mark.sweep
def test_nobody_waits_until_a_large_task_is_taken_over(background: Background) -> None:
    """Starting takes a few ms, though the process takes 0.7 s and a pipe holds only 64 KiB."""
    durations = []
    for _ in range(3):
        begun = time.monotonic()
        background.start(work.size, bytes(2**20))
        durations.append(time.monotonic() - begun)

    assert min(durations) < 0.15
    assert findings(background) == [2**20]


def test_looking_does_not_wait(background: Background) -> None:
    background.start(work.dawdle)

    begun = time.monotonic()
    list(background.results())

    assert time.monotonic() - begun < 1


def test_work_that_is_cancelled_ends_at_once(background: Background) -> None:
    background.start(work.dawdle)
    pid = background.pid
    assert pid is not None

    background.cancel()

    assert not background.running
    assert not alive(pid)
    assert list(background.results()) == []


@pytest.mark.sweep
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="nothing can be ignored here")
def test_work_that_ignores_a_request_to_end_ends_at_once(background: Background) -> None:
    """So does everything started where SIGTERM is ignored: that is inherited."""
    background.start(work.ignore)
    until(lambda: bool(list(background.results())))

    begun = time.monotonic()
    background.cancel()

    assert time.monotonic() - begun < 30  # it would go on for 120 s


@pytest.mark.sweep
def test_work_that_dies_in_the_middle_of_a_finding_has_found_nothing(
    background: Background,
) -> None:
    background.start(work.half)
    pid = background.pid
    assert pid is not None
    until(lambda: not alive(pid))

    assert list(background.results()) == []
    assert not background.running


@pytest.mark.sweep
def test_new_work_takes_the_place_of_the_old(background: Background) -> None:
    background.start(work.dawdle)
    before = background.pid
    background.start(work.count, 2)

    assert before is not None
    assert not alive(before)
    assert findings(background) == [0, 1]


@pytest.mark.sweep
@pytest.mark.skipif(not hasattr(os, "nice"), reason="there are no priorities here")
def test_the_work_gives_way_to_the_window(background: Background) -> None:
    background.start(work.priority)

    assert findings(background) == [min(os.nice(0) + 5, 19)]


@pytest.mark.sweep
@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="all hear signals there")
def test_the_work_hears_no_signal_that_is_for_the_window(background: Background) -> None:
    """It would print a traceback at Ctrl-C."""
    background.start(work.deaf_to)

    assert findings(background) == [set(interrupts.SIGNALS)]


@pytest.mark.sweep
def test_a_window_that_is_killed_leaves_no_orphan() -> None:
    text = (
        "from sandbox.app.background_process import Background\n"
        "from tests.app import work\n"
        "import time\n"
        "if __name__ == '__main__':\n"
        "    background = Background()\n"
        "    background.start(work.dawdle)\n"
        "    found = []\n"
        "    while background.running and not found:\n"
        "        found = list(background.results())\n"
        "        time.sleep(0.01)\n"
        "    print(found[0], flush=True)\n"
        "    time.sleep(600)\n"
    )
    command = [sys.executable, "-c", limited() + text]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as window:
        assert window.stdout is not None
        try:
            pid = int(window.stdout.readline())
            assert alive(pid)
        finally:
            window.kill()

    until(lambda: not alive(pid))
