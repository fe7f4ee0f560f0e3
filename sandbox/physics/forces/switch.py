"""A switch: whether a force acts that events turn on and off.

A switch knows when it was thrown, so that a recorded run, too, tells what acted at each instant.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from sandbox.model.expressions import Array


@dataclass(slots=True)
class Switch:
    """Whether something acts, and when that has changed.

    Attributes
    ----------
    first
        Whether it acts at the start.
    thrown
        The times at which it was thrown, in order [s].
    """

    first: bool
    thrown: list[float] = field(default_factory=list)

    def turn(self, t: float, *, on: bool) -> None:
        """Let it be on, or off, from a time on [s]."""
        if self.now is not on:
            self.thrown.append(t)

    @property
    def now(self) -> bool:
        """Whether it acts by now."""
        return self.first is not bool(len(self.thrown) % 2)

    def at(self, t: Array) -> Array:
        """Return 1 at the times at which it acts, 0 at others: (...)."""
        count = np.searchsorted(np.array(self.thrown), t, side="right")
        return np.asarray((count % 2 == 1) != self.first, dtype=float)


Switches = Mapping[str, Switch]
"""Switches by the names of the effects, forces and springs that they switch."""
