"""Pieces of work that the tests give to another process."""

import os
import time
from collections.abc import Iterator


def count(many: int) -> Iterator[int]:
    """Yield numbers."""
    yield from range(many)


def dawdle() -> Iterator[int]:
    """Yield the process, and then take very long."""
    yield os.getpid()
    time.sleep(600)
    yield 0


def priority() -> Iterator[int]:
    """Yield by how much the process gives way."""
    yield os.nice(0)
