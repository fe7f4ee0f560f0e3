"""Taking runs with smaller and smaller steps, of several schemes in turn, as far as the time goes.

Whichever next run takes least is taken, so that no scheme spends the time of the others. A scheme
that tells how far it has to go waits for those that do not yet, and what cannot be the cheapest any
more is left.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.physics.accuracy.refinement import Ladder, judged
from sandbox.physics.accuracy.runs import Stop, Watched, record
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError

Progress = Callable[[float, str], None]
"""Is told which share of the time is spent, and what comes next."""

FEWEST = 3
"""Runs that must agree before it is believed, as long as there is time for them."""

OVERDRAFT = 1.25
"""How often the time may be spent as long as nothing tells how far it has to go."""

DEARER = 2.0
"""How many times as long as what will do a run takes, looked at as it is, that will not do."""


@dataclass(slots=True)
class Climber:
    """Runs a level at a rate, and at twice that again and again, until one but the last will do.

    A run that has to stop, for its steps are too long, counts for nothing.

    Attributes
    ----------
    level, values, wanted, target
        What is run and watched, and how small its errors are to be.
    stepping
        What is run next.
    ladder
        The runs so far; None if there are no two.
    failure
        Why the last one had to stop; None if it did not.
    """

    level: Level
    values: Values
    stepping: Stepping
    wanted: Sequence[Watched]
    target: float
    ladder: Ladder | None = None
    failure: SimulationError | None = None
    _traces: list[Trace] = field(default_factory=list)
    _seconds: float = 0.0  # what the last run took

    def run(self, stop: Stop) -> None:
        """Take the next run.

        Raises
        ------
        Cancelled
            If `stop` said so.
        """
        begun = thread_time()
        self.failure = None
        try:
            self._traces.append(record(self.level, self.values, self.stepping, self.wanted, stop))
        except SimulationError as error:
            self._traces, self.ladder, self.failure = [], None, error
        if len(self._traces) > 1:
            self.ladder = judged(self._traces, self.wanted)
        self._seconds = thread_time() - begun
        self.stepping = self.stepping.model_copy(update={"rate": 2 * self.stepping.rate})

    def refine(self, stop: Stop) -> None:
        """Take one run at a rate between two others, of which only the finer will do.

        Raises
        ------
        Cancelled
            If `stop` said so.
        """
        rate = self.ladder and self.ladder.between(self.target)
        if not (self.ladder and rate):
            return
        with suppress(SimulationError):
            stepping = self.stepping.at(rate)
            trace = record(self.level, self.values, stepping, self.wanted, stop)
            self.ladder = self.ladder.joined(trace, self.wanted)

    @property
    def next_seconds(self) -> float:
        """What the next run will take [s]; 0 if there was none yet."""
        return 2 * self._seconds

    @property
    def done(self) -> bool:
        """Whether a run will do, or there is no higher rate."""
        found = self.ladder and len(self._traces) >= FEWEST and self.ladder.cheapest(self.target)
        return bool(found) or self.stepping.rate > HIGHEST_RATE

    @property
    def promised(self) -> float:
        """What a run that will do takes [s], as far as one can tell; infinite if one cannot."""
        ladder = self.ladder
        if not ladder or len(self._traces) < FEWEST:
            return inf
        last = ladder.traces[-1].stepping.rate
        if found := ladder.cheapest(self.target):
            return self._seconds * found[0].stepping.rate / last
        rate = ladder.rate_for(self.target) if ladder.believable(self.target) else inf
        return self._seconds * rate / last if rate <= HIGHEST_RATE else inf

    @property
    def least(self) -> float:
        """What a run that will do takes [s] at the least: none that is done with but the last."""
        return min(self._seconds, self.promised)


def climb(
    climbers: Sequence[Climber], seconds: float, stop: Stop, progress: Progress | None = None
) -> None:
    """Take runs in turn, until all will do, or the time is spent; then lower rates, if any is left.

    Where bodies touch, the first is the judge of the others, and is never too dear.

    Raises
    ------
    Cancelled
        If `stop` said so.
    """
    begun = thread_time()
    while left := _worthwhile(climbers):
        next_ = min(left, key=lambda climber: climber.next_seconds)
        known = any(climber.promised < inf for climber in climbers)
        budget = seconds if known else OVERDRAFT * seconds
        spent = thread_time() - begun
        if spent + next_.next_seconds > budget:
            break
        if progress:
            progress(spent / budget, f"{next_.stepping.scheme} at {next_.stepping.rate:g} Hz")
        next_.run(stop)
    enough = DEARER * min(climber.promised for climber in climbers)
    for climber in climbers:
        if climber.promised <= min(enough, begun + seconds - thread_time()):
            climber.refine(stop)


def _worthwhile(climbers: Sequence[Climber]) -> list[Climber]:
    """Return those that may still find something cheaper, or show that it is as they promise.

    Where bodies touch all must show it, unless that is dear and pymunk as it comes.
    """
    left = [climber for climber in climbers if not climber.done]
    contact = climbers[0].level.effects.contact
    trusted = [c for c in climbers[bool(contact) :] if not c.stepping.as_it_comes]
    enough = DEARER * min((climber.promised for climber in trusted), default=inf)
    if contact:
        return [c for c in left if c in trusted or c is climbers[0] or c.least <= enough]
    left = [climber for climber in left if climber.least <= enough]
    unknown = [climber for climber in left if climber.promised == inf]
    return unknown or [climber for climber in left if climber.promised <= enough]
