"""Pieces of work that the tests give to another process."""

import os
import signal
import time
from collections.abc import Iterator
from threading import Timer

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.accuracy import study


def count(many: int) -> Iterator[int]:
    """Yield numbers."""
    yield from range(many)


def size(data: bytes) -> Iterator[int]:
    """Yield how much was handed over."""
    yield len(data)


def dawdle() -> Iterator[int]:
    """Yield the process, and then take very long."""
    yield os.getpid()
    time.sleep(600)
    yield 0


def ignore() -> Iterator[int]:
    """Do as `dawdle` does, deaf to whoever asks for an end."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    yield from dawdle()


def half() -> Iterator[bytes]:
    """Yield what is so large that sending it takes a while, and die at that."""
    Timer(0.5, os._exit, (1,)).start()
    yield bytes(10_000_000)


def priority() -> Iterator[int]:
    """Yield by how much the process gives way."""
    yield os.nice(0)


def short_study(level: Level, values: Values) -> Iterator[study.Finding]:
    """Study a level, with less time for each scheme."""
    study.REFINING = 0.1  # in a process of its own
    yield from study.study(level, values)
