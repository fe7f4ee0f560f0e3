"""The computing time of steps, apart from whatever else the machine does."""

from collections import deque
from time import perf_counter

import numpy as np

from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.time_limit import Patience
from sandbox.physics.stepping.world import World

MEMORY = 300  # steps


class Clock:
    """Times steps. Disturbances only add to a time, so the lower quartile of the last counts."""

    def __init__(self) -> None:
        self._last: deque[float] = deque(maxlen=MEMORY)

    def take_step(self, world: World, patience: Patience) -> Snapshot:
        """Let a world take a step, note how long it has taken, and return the state there.

        Raises
        ------
        SandboxError
            If the run had to stop, or the step took too long.
        """
        begun = perf_counter()
        with patience.within_steps():
            snapshot = patience.advance(world)
        self._last.append(perf_counter() - begun)
        return snapshot

    @property
    def step(self) -> float | None:
        """How long a step takes [s], with reading its state; None before the first."""
        return float(np.quantile(self._last, 0.25)) if self._last else None
