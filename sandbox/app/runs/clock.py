"""The computing time of steps, apart from whatever else the machine does."""

from collections import deque

import numpy as np

MEMORY = 300  # steps


class Clock:
    """Times steps. What disturbs one only adds to it: the lower quartile of the last is told."""

    def __init__(self) -> None:
        self._last: deque[float] = deque(maxlen=MEMORY)

    def note(self, seconds: float) -> None:
        """Note how long a step has taken [s]."""
        self._last.append(seconds)

    @property
    def step(self) -> float | None:
        """How long a step takes [s], with reading its state; None before the first."""
        return float(np.quantile(self._last, 0.25)) if self._last else None
