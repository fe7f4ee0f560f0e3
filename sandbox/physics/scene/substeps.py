"""Substeps: a drift and the kick after it."""

from typing import NamedTuple


class Substep(NamedTuple):
    """A drift and the kick after it."""

    drift: float
    """s, backwards if negative"""
    ahead: float
    """how much of the step the drift brings to an end"""
    kick: float
    """s, how long the kick lasts"""
    following: float
    """s, the drift after that kick"""

    @property
    def scale(self) -> float:
        """What forces are multiplied by, for pymunk's kick lasts as long as the drift."""
        return self.kick / self.drift


def once(dt: float) -> Substep:
    """Return the one part of a step of a length [s]: leapfrog's.

    >>> once(0.5)
    Substep(drift=0.5, ahead=1, kick=0.5, following=0.5)
    """
    return Substep(dt, 1, dt, dt)
