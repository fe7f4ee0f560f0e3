"""What every program of the project does first, whichever module Python is asked to run."""

from collections.abc import Iterator
from contextlib import contextmanager

from sandbox import environment_defaults, interrupts, standard_streams


@contextmanager
def started() -> Iterator[None]:
    """End in good order within this, whatever signals come and whatever becomes of the streams.

    A library may have made an error of its own of the exit that a signal has asked for.
    """
    interrupts.install()
    standard_streams.install()
    environment_defaults.install()
    with standard_streams.standard():
        try:
            yield
        except Exception:
            interrupts.insist()
            raise
