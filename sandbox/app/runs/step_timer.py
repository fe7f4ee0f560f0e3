"""Measures the computing time of steps, without disturbances by other processes."""

from collections import deque
from time import perf_counter

import numpy as np

from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.time_limit import TimeLimit
from sandbox.physics.stepping.world import World

MEMORY = 300  # steps


class StepTimer:
    """Times steps. Other processes only lengthen a step, so the lower quartile counts."""

    def __init__(self) -> None:
        self._last: deque[float] = deque(maxlen=MEMORY)

    def take_step(self, world: World, patience: TimeLimit) -> Snapshot:
        """Advance a world by a step, record the time that it took, and return the new state.

        Raises `SandboxError` if the step failed, or took too long.
        """
        begun = perf_counter()
        with patience.within_steps():
            snapshot = patience.advance(world)
        self._last.append(perf_counter() - begun)
        return snapshot

    @property
    def step_time(self) -> float | None:
        """The time of a step, with reading its state [s]; None before the first."""
        return float(np.quantile(self._last, 0.25)) if self._last else None
