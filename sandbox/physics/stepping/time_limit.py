"""The limit on computing time: stops a run whose steps take too long to wait for.

Most excessive work is counted and refused before a step is taken; this limit is for work that
cannot be counted. A step is aborted at a cancellation point; if it has none, the run ends after the
step.
"""

from contextlib import AbstractContextManager
from time import perf_counter, thread_time

from sandbox.model.translatable_message import Message
from sandbox.physics.state.cancellation_points import cancellable
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

LONGEST = 30.0
"""s, the longest time of a step."""

HINT = Message("reduce the bodies that touch or are joined, or the 'iterations'")


class TimeLimit:
    """The patience with a run: lost if one step computes too long, or two in a row take too long.

    A single step may have been delayed by the machine, or because the process was suspended.
    """

    def __init__(self, longest: float = LONGEST) -> None:
        self._longest, self._took = longest, 0.0
        self._t, self._started = 0.0, perf_counter()
        self._computed: float | None = None  # at the first cancellation point of the step [s]

    def lost(self, seconds: float) -> bool:
        """Note the time of a step [s], and return whether it is the second long one in a row."""
        before, self._took = self._took, seconds
        return min(before, seconds) > self._longest

    def within_steps(self) -> AbstractContextManager[None]:
        """Return a context, around many steps, in which it can also be lost within a step.

        Before the first step it can be lost within the kick at the start of a run.
        """
        return cancellable(self._look)

    def advance(self, world: World) -> Snapshot:
        """Take a step of a world, and return the state after it.

        Raises `SimulationError` if the run had to stop; if this step has computed too long, or is
        the second in a row to take too long.
        """
        self._started, self._computed, self._t = perf_counter(), None, world.t
        snapshot = world.advance()
        took = perf_counter() - self._started
        if self.lost(took):
            raise _spent(world.t, took, self._longest)
        return snapshot

    def _look(self) -> None:
        if self._computed is None:
            self._computed = thread_time()
        elif perf_counter() - self._started > self._longest:
            computed = thread_time() - self._computed
            if computed > self._longest:
                raise _spent(self._t, computed, self._longest)


def _spent(t: float, took: float, longest: float) -> SimulationError:
    """Return the error for a step that took too long, given its time and the limit [s]."""
    message = Message(
        "a step takes {took:.0f} s; at most {longest:g} s are allowed", took=took, longest=longest
    )
    return SimulationError("", t, message, hint=HINT)
