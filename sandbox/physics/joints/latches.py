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
        Theirs; they hold nothing before.
    tie
        Lets one that is solved with others hold what there is at a time [s].
    tied
        When they were tied, by name [s].
    """

    names: frozenset[str]
    tie: Callable[[str, float], None]
    tied: dict[str, float] = field(default_factory=dict)

    def is_open(self, name: str, t: float) -> bool:
        """Whether a joint has not caught yet at a time [s]."""
        return name in self.names and not t >= self.tied.get(name, np.inf)
