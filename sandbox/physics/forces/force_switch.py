"""Switches of forces that events turn on and off.

A switch stores the times at which it was thrown, so it can be evaluated for a recorded run as well.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from sandbox.model.expressions import Array


@dataclass(slots=True)
class Switch:
    """Whether a force acts, as a function of time."""

    first: bool
    """Whether the force acts at the start."""
    thrown: list[float] = field(default_factory=list)
    """The times at which the switch was thrown, in order [s]."""

    def turn(self, t: float, *, on: bool) -> None:
        """Turn it on or off from a time on [s]."""
        if self.now is not on:
            self.thrown.append(t)

    @property
    def now(self) -> bool:
        """Whether it is on now."""
        return self.first is not bool(len(self.thrown) % 2)

    def at(self, t: Array) -> Array:
        """Return 1 at times at which it is on, and 0 at others: (...)."""
        count = np.searchsorted(np.array(self.thrown), t, side="right")
        return np.asarray((count % 2 == 1) != self.first, dtype=float)


Switches = Mapping[str, Switch]
"""Switches, by the names of their effects, forces and springs."""
