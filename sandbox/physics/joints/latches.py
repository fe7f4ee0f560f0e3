"""Latches: joints that are open until an event closes them."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, slots=True)
class Latches:
    """The joints of a scene that events tie.

    Attributes
    ----------
    names
        The names of these joints, which are inactive until they are tied.
    tie
        Ties a joint that is solved together with others, at a time [s].
    tied
        The times at which joints were tied, by name [s].
    """

    names: frozenset[str]
    tie: Callable[[str, float], None]
    tied: dict[str, float] = field(default_factory=dict)

    def is_open(self, name: str, t: float) -> bool:
        """Return whether a joint is still open at a time [s]."""
        return name in self.names and not t >= self.tied.get(name, np.inf)
