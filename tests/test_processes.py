"""Work spread over processes ends with the process that has spread it."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from sandbox.interrupts import ENDED, INTERRUPTED
from sandbox.model.errors import SandboxError
from sandbox.processes import spread
from tests.elsewhere import PATIENCE, ROOT, python
from tests.patience import alive

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals as on Unix")


def until(holds: Callable[[], bool]) -> bool:
    """Wait until a condition holds, and return whether it does."""
    end = time.monotonic() + PATIENCE / 10
    while not holds() and time.monotonic() < end:
        time.sleep(0.01)
    return holds()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks the kernel")
def test_the_server_of_processes_does_not_hear_ctrl_c_even_while_it_starts() -> None:
    code = (
        "from sandbox import processes; processes.prepare()\n"
        "from multiprocessing.forkserver import _forkserver\n"
        "from pathlib import Path\n"
        "print(Path(f'/proc/{_forkserver._forkserver_pid}/status').read_text())"
    )

    status = python("-c", code).stdout

    blocked = next(line for line in status.splitlines() if line.startswith("SigBlk"))
    assert int(blocked.split()[1], 16) & 1 << signal.SIGINT - 1


@pytest.fixture
def busy(tmp_path: Path) -> Iterator[tuple[subprocess.Popen[bytes], list[int]]]:
    """Yield a process that shares its work with two others, and their IDs."""
    command = [sys.executable, "-m", "tests.patience", str(tmp_path)]
    with subprocess.Popen(command, cwd=ROOT, stderr=subprocess.DEVNULL) as process:
        assert until(lambda: len(list(tmp_path.iterdir())) == 2)
        workers = [int(path.name) for path in tmp_path.iterdir()]
        yield process, workers
        for pid in (process.pid, *workers):
            if alive(pid):
                os.kill(pid, signal.SIGKILL)


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("number", "status"),
    [
        (signal.SIGTERM, ENDED),
        (signal.SIGINT, INTERRUPTED),
        (signal.SIGKILL, -signal.SIGKILL),
    ],
)
def test_no_process_outlives_the_one_that_has_started_it(
    busy: tuple[subprocess.Popen[bytes], list[int]], number: int, status: int
) -> None:
    process, workers = busy

    process.send_signal(number)

    assert process.wait(PATIENCE / 10) == status
    assert until(lambda: not any(map(alive, workers)))


@pytest.mark.sweep
def test_what_goes_wrong_in_another_process_is_raised_here() -> None:
    with pytest.raises(ZeroDivisionError):
        list(spread(divide, [1, 0, 2], 1))


def divide(by: int) -> float:
    return 1 / by


def test_a_process_that_is_ended_from_outside_is_told_in_a_sentence() -> None:
    with pytest.raises(SandboxError, match="was ended from outside"):
        list(spread(end, [signal.SIGKILL], 1))


def end(number: int) -> None:
    os.kill(os.getpid(), number)
