"""A kick, as it is handed to everything that acts in it."""

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
    """A kick of n bodies, as it is handed on to what acts in it.

    Time is counted in steps, so that it is the same everywhere to the last digit. The kick of
    most steps differs from the last in nothing but the time, and is made once.

    Attributes
    ----------
    clock
        Counts the steps.
    ahead
        When it acts: so many steps after the last that was counted.
    length
        How long it lasts [s].
    drift
        How long the drift after it lasts [s]; backwards if negative.
    ends
        Where that drift is taken to end, so many steps after the kick.
    scale
        What forces are multiplied by, for pymunk's kick lasts as long as the drift before it.
    start
        (n, 3), the velocities right at its start, of bodies that stand still to be kicked
        [m/s, rad/s]; None where they come out of a drift, with velocities half a kick old.
    at_step
        Whether it begins at a step, with the velocities there.
    """

    clock: Clock
    ahead: float
    length: float
    drift: float
    ends: float = 1
    scale: float = 1.0
    start: Array | None = None
    at_step: bool = False

    @property
    def t(self) -> float:
        """When it acts [s]."""
        return (self.clock.steps + self.ahead) * self.clock.dt

    @property
    def until(self) -> float:
        """The end of the drift after it, through which joints hold [s]."""
        return (self.clock.steps + self.ahead + self.ends) * self.clock.dt


Work = Callable[[Kick], None]
"""A part of a kick; it is called with the kick."""
