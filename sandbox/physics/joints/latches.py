"""Latches: joints that are open until an event closes them."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, slots=True)
class Latches:
    """The joints of a scene that events tie."""

    names: frozenset[str]
    """The names of these joints, which are inactive until they are tied."""
    tie: Callable[[Collection[str], float], None]
    """Ties joints that are solved together with others, at a time [s]."""
    tied: dict[str, float] = field(default_factory=dict)
    """The times at which joints were tied, by name [s]."""

    def is_open(self, name: str, t: float) -> bool:
        """Return whether a joint is still open at a time [s]."""
        return name in self.names and not t >= self.tied.get(name, np.inf)
