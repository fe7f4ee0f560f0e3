"""Cancellation points: places in a long computation where it can be broken off.

The loops that can make one step last for seconds come to a `cancellation_point` each time round.
pymunk's own step and a call of LAPACK have none, and always run to their end. A cancellation point
does nothing unless somebody has asked for it by `cancellable`.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Look = Callable[[], None]
"""Looks at the situation; raises a `SandboxError` to cancel."""

_asked: tuple[Look, ...] = ()


def cancellation_point() -> None:
    """Let the waiting caller look; a run that it cancels has ended.

    Raises
    ------
    SandboxError
        The errors they raise.
    """
    for look in _asked:
        look()


@contextmanager
def cancellable(look: Look) -> Iterator[None]:
    """Ask at every cancellation point inside, together with earlier requests."""
    global _asked
    before, _asked = _asked, (*_asked, look)
    try:
        yield
    finally:
        _asked = before
