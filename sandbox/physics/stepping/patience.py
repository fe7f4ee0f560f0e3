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
    """Lets a world take steps, but for two in a row that take too long.

    A single one may have been held up by the machine, or by whoever has stopped the process.
    """

    def __init__(self, world: World) -> None:
        self._world, self._took = world, 0.0

    def advance(self) -> None:
        """Take a step.

        Raises
        ------
        SimulationError
            If the run had to stop, or this is the second step in a row that has taken too long.
        """
        before, started = self._took, perf_counter()
        self._world.advance()
        self._took = perf_counter() - started
        if min(before, self._took) > LONGEST:
            message = f"a step takes {self._took:.0f} s, and {LONGEST:g} s are the most"
            raise SimulationError("", self._world.t, message, hint=HINT)
