"""Tasks that the tests give to another process."""

import os
import signal
import time
from collections.abc import Iterator
from threading import Timer

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.accuracy import error_causes_and_costs


def count(many: int) -> Iterator[int]:
    """Yield numbers."""
    yield from range(many)


def size(data: bytes) -> Iterator[int]:
    """Yield the size of what was handed over."""
    yield len(data)


def dawdle() -> Iterator[int]:
    """Yield the process ID, and then take very long."""
    yield os.getpid()
    time.sleep(600)
    yield 0


def ignore() -> Iterator[int]:
    """Do as `dawdle` does, but ignore requests to end."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    yield from dawdle()


def half() -> Iterator[bytes]:
    """Send a value so large that it takes a while, and die meanwhile."""
    Timer(0.5, os._exit, (1,)).start()
    yield bytes(10_000_000)


def priority() -> Iterator[int]:
    """Yield the niceness of the process."""
    yield os.nice(0)


def deaf_to() -> Iterator[set[int]]:
    """Yield the signals that the process does not hear."""
    yield set(signal.pthread_sigmask(signal.SIG_BLOCK, ()))


def short_study(level: Level, values: Values) -> Iterator[error_causes_and_costs.Finding]:
    """Study a level, with less time for each scheme."""
    error_causes_and_costs.REFINING = 0.1  # in a process of its own
    yield from error_causes_and_costs.study(level, values)
