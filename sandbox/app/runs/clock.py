"""The computing time of steps, apart from whatever else the machine does."""

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter

import numpy as np

MEMORY = 300  # steps


class Clock:
    """Times steps. What disturbs one only adds to it: the lower quartile of the last is told."""

    def __init__(self) -> None:
        self._last: deque[float] = deque(maxlen=MEMORY)

    @contextmanager
    def running(self) -> Iterator[None]:
        """Time what is done within."""
        start = perf_counter()
        yield
        self._last.append(perf_counter() - start)

    @property
    def step(self) -> float | None:
        """How long a step takes [s], with reading its state; None before the first."""
        return float(np.quantile(self._last, 0.25)) if self._last else None
