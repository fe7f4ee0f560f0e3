"""Pieces of work that the tests give to another process."""

import os
import time
from collections.abc import Iterator

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics import study


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


def priority() -> Iterator[int]:
    """Yield by how much the process gives way."""
    yield os.nice(0)


def short_study(level: Level, values: Values) -> Iterator[study.Finding]:
    """Study a level, with less time for each scheme."""
    study.CLIMB = 0.1  # in a process of its own
    yield from study.study(level, values)
