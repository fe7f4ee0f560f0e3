"""Work spread over processes ends with the process that has spread it."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from sandbox.interrupts import ENDED, INTERRUPTED, SIGNALS, STATUS
from sandbox.model.errors import SandboxError
from sandbox.parallel_processes import METHOD, spread
from tests.elsewhere import PATIENCE, ROOT, python
from tests.patience import alive

pytestmark = [
    pytest.mark.skipif(os.name == "nt", reason="signals as on Unix"),
    pytest.mark.usefixtures("hangups"),
]


def until(holds: Callable[[], bool]) -> bool:
    """Wait until a condition holds, and return whether it does."""
    end = time.monotonic() + PATIENCE / 10
    while not holds() and time.monotonic() < end:
        time.sleep(0.01)
    return holds()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks the kernel")
def test_the_server_of_processes_hears_no_signal_even_while_it_starts() -> None:
    code = (
        "from sandbox import parallel_processes; parallel_processes.prepare()\n"
        "from multiprocessing.forkserver import _forkserver\n"
        "from multiprocessing.resource_tracker import _resource_tracker\n"
        "from pathlib import Path\n"
        "for pid in (_forkserver._forkserver_pid, _resource_tracker._pid):\n"
        "    print(Path(f'/proc/{pid}/status').read_text())"
    )

    status = python("-c", code).stdout

    server, tracker = [
        int(line.split()[1], 16) for line in status.splitlines() if line.startswith("SigBlk")
    ]
    assert all(server & 1 << number - 1 for number in SIGNALS)
    assert tracker & 1 << signal.SIGHUP - 1  # it ignores the others


@pytest.mark.skipif(METHOD != "forkserver", reason="another method starts processes here")
@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_while_a_process_starts_waits_until_it_has_started(number: signal.Signals) -> None:
    """What has half started would look for things of a process that has ended, and say so."""
    code = (
        "import os\n"
        "from multiprocessing.popen_forkserver import Popen\n"
        "from sandbox import interrupts, parallel_processes\n"
        "launch = Popen._launch\n"
        "def interrupted(*arguments):\n"
        "    launch(*arguments)\n"
        f"    os.kill(os.getpid(), {number:d})\n"
        "Popen._launch = interrupted\n"
        "interrupts.install()\n"
        "list(parallel_processes.spread(abs, [-1], 1))\n"
    )

    done = python("-c", code)

    assert (done.returncode, done.stderr) == (STATUS + number, "")


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
        (signal.SIGHUP, STATUS + signal.SIGHUP),
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
def test_a_closed_terminal_ends_the_process_and_all_that_it_has_started(tmp_path: Path) -> None:
    """All of its processes hear of that."""
    master, terminal = os.openpty()
    code = (
        "import fcntl, termios\n"
        "from sandbox import interrupts, parallel_processes\n"
        "from tests.patience import linger\n"
        "interrupts.install()\n"
        "fcntl.ioctl(0, termios.TIOCSCTTY, 0)\n"
        f"list(parallel_processes.spread(linger, [{str(tmp_path)!r}] * 2, 2))"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code],
        cwd=ROOT, stdin=terminal, stderr=subprocess.PIPE, text=True, start_new_session=True,
    ) as process:  # fmt: skip
        os.close(terminal)
        assert until(lambda: len(list(tmp_path.iterdir())) == 2)
        workers = [int(path.name) for path in tmp_path.iterdir()]

        os.close(master)

        _, error = process.communicate(timeout=PATIENCE / 10)
    assert (process.returncode, error) == (STATUS + signal.SIGHUP, "")
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
