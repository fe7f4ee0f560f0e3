"""Cancellation points: places in a long computation where it can be cancelled.

Loops that can make a step last for seconds call `cancellation_point` in each iteration. pymunk's
step and calls of LAPACK have none, and always run to their end. A cancellation point does nothing
outside of `cancellable`.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Look = Callable[[], None]
"""A check that raises a `SandboxError` to cancel."""

_asked: tuple[Look, ...] = ()


def cancellation_point() -> None:
    """Call the checks of all enclosing `cancellable` blocks; a run that they cancel has ended.

    Raises `SandboxError` if a check cancels.
    """
    for look in _asked:
        look()


@contextmanager
def cancellable(look: Look) -> Iterator[None]:
    """Call a check at every cancellation point inside, after those of outer blocks."""
    global _asked
    before, _asked = _asked, (*_asked, look)
    try:
        yield
    finally:
        _asked = before
