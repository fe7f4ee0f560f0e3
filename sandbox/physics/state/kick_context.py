"""A kick, as it is passed to everything that acts in it."""

from collections.abc import Callable
from dataclasses import dataclass

from sandbox.model.expressions import Array


@dataclass(slots=True)
class Clock:
    """Counts steps: the time is `steps * dt`."""

    dt: float  # s
    steps: int = 0

    def after(self, ahead: float) -> float:
        """Return the time [s] a number of steps later."""
        return (self.steps + ahead) * self.dt


@dataclass(frozen=True, slots=True)
class Kick:
    """A kick of n bodies, as it is passed to everything that acts in it.

    Time is counted in steps, so that it is the same everywhere to the last digit. The kicks of most
    steps differ only in time, so one object serves for all of them.
    """

    clock: Clock
    """Counts the steps."""
    ahead: float
    """The time of the kick, in steps after the last that was counted."""
    length: float
    """Its duration [s]."""
    drift: float
    """The duration of the drift after it, negative if backwards [s]."""
    ends: float = 1
    """The end of that drift, in steps after the kick."""
    scale: float = 1.0
    """The factor of forces, since pymunk's kick lasts as long as the drift before it."""
    start: Array | None = None
    """(n, 3), the velocities at its start [m/s, rad/s], for a kick of bodies that are held in
    place; None if it follows a drift, whose velocities are those of half a kick earlier."""
    at_step: bool = False
    """Whether it begins at a step, with the velocities there."""

    @property
    def t(self) -> float:
        """The time of the kick [s]."""
        return (self.clock.steps + self.ahead) * self.clock.dt

    @property
    def until(self) -> float:
        """The time at the end of the drift after it, where joints hold [s]."""
        return (self.clock.steps + self.ahead + self.ends) * self.clock.dt


Work = Callable[[Kick], None]
"""A part of a step; it is called with the kick."""
