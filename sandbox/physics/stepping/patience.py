"""Stops a run whose steps take so long that nobody can wait for it.

What a step takes is counted before it is taken wherever that can be; this is for what is left.
"""

from time import perf_counter

from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World

LONGEST = 30.0
"""s, that a step may take."""

HINT = "let it have fewer bodies that touch or are joined, or fewer 'iterations'"


class Patience:
    """Is lost where two steps in a row take too long.

    A single one may have been held up by the machine, or by whoever has stopped the process.

    Parameters
    ----------
    longest
        How long a step may take [s].
    """

    def __init__(self, longest: float = LONGEST) -> None:
        self._longest, self._took = longest, 0.0

    def lost(self, seconds: float) -> bool:
        """Take note of how long a step took [s], and return whether it was one too many."""
        before, self._took = self._took, seconds
        return min(before, seconds) > self._longest

    def advance(self, world: World) -> None:
        """Let a world take a step.

        Raises
        ------
        SimulationError
            If the run had to stop, or this is the second step in a row that has taken too long.
        """
        started = perf_counter()
        world.advance()
        took = perf_counter() - started
        if self.lost(took):
            told = f"a step takes {took:.0f} s, and {self._longest:g} s are the most"
            raise SimulationError("", world.t, told, hint=HINT)
