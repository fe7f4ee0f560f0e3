"""Substeps: a drift and the kick after it."""

from typing import NamedTuple


class Substep(NamedTuple):
    """A drift and the kick after it."""

    drift: float
    """s, backwards if negative"""
    ahead: float
    """the fraction of the step that is over after the drift"""
    kick: float
    """s, the duration of the kick"""
    following: float
    """s, the duration of the drift after that kick"""

    @property
    def scale(self) -> float:
        """The factor of forces, since pymunk's kick lasts as long as the drift before it."""
        return self.kick / self.drift


def once(dt: float) -> Substep:
    """Return the single substep of a leapfrog step of a duration [s].

    >>> once(0.5)
    Substep(drift=0.5, ahead=1, kick=0.5, following=0.5)
    """
    return Substep(dt, 1, dt, dt)
