"""Taking runs with smaller and smaller steps, of several schemes in turn, as far as the work goes.

Whichever next run takes least is taken, so that no scheme spends the time of the others, and what
cannot be the cheapest any more is left. Work is counted, so the same request takes the same runs;
a clock ends only what is far more work than the count tells.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.physics.accuracy.refinement import SLOWEST, Ladder, held_against, judged
from sandbox.physics.accuracy.runs import SEEN, Stop, Watched, record
from sandbox.physics.accuracy.work import LOOK, step_work
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError

Progress = Callable[[float, str], None]
"""Is told which share of the time is spent, and what comes next."""

FEWEST = 3
"""Runs of a scheme before it tells how far it has to go."""

DEARER = 2.0
"""How many times as much work as another, as far as both tell what they need, is too much."""

PATIENCE = 6.0
"""How many times as long as counted the runs may take."""


@dataclass(slots=True)
class Climber:
    """Runs a level at a rate, and at twice that again and again.

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
    step
        How much work a step is [s], as counted.
    """

    level: Level
    values: Values
    stepping: Stepping
    wanted: Sequence[Watched]
    target: float
    ladder: Ladder | None = None
    failure: SimulationError | None = None
    step: float = 0.0
    _traces: list[Trace] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.step = step_work(self.level, self.values, self.stepping)

    def run(self, stop: Stop) -> None:
        """Take the next run.

        Raises
        ------
        Cancelled
            If `stop` said so.
        """
        self.failure = None
        try:
            self._traces.append(record(self.level, self.values, self.stepping, self.wanted, stop))
        except SimulationError as error:
            self._traces, self.ladder, self.failure = [], None, error
        if len(self._traces) > 1:
            self.ladder = judged(self._traces, self.wanted)
        self.stepping = self.stepping.model_copy(update={"rate": 2 * self.stepping.rate})

    def work(self, rate: float) -> float:
        """Return how much work a run at a rate is [s], as counted."""
        looks = min(rate, 2 * SEEN)
        return self.level.duration(self.values) * (rate * self.step + looks * LOOK)

    @property
    def over(self) -> bool:
        """Whether there is no higher rate."""
        return self.stepping.rate > HIGHEST_RATE

    @property
    def needed(self) -> float:
        """The rate from which on its errors are as small as asked for, as far as it tells [Hz]."""
        ladder = self.ladder
        if not ladder or len(self._traces) < FEWEST:
            return inf
        rate = ladder.rate_for(self.target) if ladder.believable(self.target) else inf
        return max(rate, SLOWEST) if rate <= HIGHEST_RATE else inf

    def lags(self, enough: float) -> bool:
        """Whether it does not tell yet how far it has to go, and may be cheaper than enough [s]."""
        return self.needed == inf and self.step * self.stepping.rate <= enough

    @property
    def promised(self) -> float:
        """What a second of the scene is expected to take that will do [s], as counted."""
        return self.step * self.needed


def climb(
    climbers: Sequence[Climber], seconds: float, stop: Stop, progress: Progress | None = None
) -> list[Ladder]:
    """Take runs in turn, until the cheapest that will do is seen, or the work is done.

    Where bodies touch, the first is the judge of the others.

    Returns
    -------
    The ladders, each with its errors held against the best, in the order of those that have any.

    Raises
    ------
    Cancelled
        If `stop` said so.
    """
    spent, begun = 0.0, thread_time()
    ladders: list[Ladder] = []
    while left := _worthwhile(climbers, ladders):
        next_ = min(left, key=lambda climber: climber.work(climber.stepping.rate))
        work = next_.work(next_.stepping.rate)
        if spent + work > seconds or thread_time() - begun > PATIENCE * seconds:
            break
        if progress:
            progress(spent / seconds, f"{next_.stepping.scheme} at {next_.stepping.rate:g} Hz")
        spent += work
        next_.run(stop)
        ladders = held(climbers)
    return ladders


def held(climbers: Sequence[Climber]) -> list[Ladder]:
    """Return what has been climbed, each ladder with its errors against the best, that first.

    None as long as there is but pymunk as it comes, which agrees with itself on what is wrong.
    """
    found = [climber.ladder for climber in climbers if climber.ladder]
    judges = [ladder for ladder in found if not ladder.traces[0].stepping.as_it_comes]
    if not judges:
        return []
    best = min(judges, key=lambda ladder: ladder.errors[-1])
    if climbers[0].level.effects.contact:
        best = judges[0]  # only more sweeps of the solver show what it still owes
    wanted = climbers[0].wanted
    others = [held_against(ladder, best, wanted) for ladder in found if ladder is not best]
    return [best, *others]


def price(climbers: Sequence[Climber], ladder: Ladder) -> float:
    """Return how much work a step of a ladder is [s], as counted."""
    return next(c.step for c in climbers if c.ladder and c.ladder.traces is ladder.traces)


def _worthwhile(climbers: Sequence[Climber], ladders: Sequence[Ladder]) -> list[Climber]:
    """Return those that may still find something cheaper than what is seen to do.

    A run is as cheap as any finer one is not: it must be below what was found already.
    """
    left = [climber for climber in climbers if not climber.over]
    target = climbers[0].target
    seen = [
        price(climbers, ladder) * found[0].stepping.rate
        for ladder in ladders
        if (found := ladder.cheapest(target))
    ]
    least = min(seen, default=inf)
    left = [climber for climber in left if climber.step * climber.stepping.rate < least]
    if climbers[0].level.effects.contact:
        return left
    enough = DEARER * min(climber.promised for climber in climbers)
    return [climber for climber in left if climber.promised <= enough or climber.lags(enough)]
