"""The search over schemes and steps: which run comes next, as far as the work allows.

The next run is always the one that is the least work, so that no scheme spends the time of the
others. A scheme that cannot be the cheapest any more is dropped. Work is counted, so the same
request takes the same runs; a clock ends only what takes far longer than its count.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.physics.accuracy.compared_runs import SEEN, Stop, Watched, record
from sandbox.physics.accuracy.refinement import SLOWEST, Refinement, held_against, judged
from sandbox.physics.accuracy.step_work import LOOK, step_work
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError

Progress = Callable[[float, str], None]
"""Is called with the share of the time that is spent, and what comes next."""

FEWEST = 3
"""The runs of a scheme before its remaining work is estimated."""

DEARER = 2.0
"""A scheme is dropped if it needs this many times the work of another."""

PATIENCE = 6.0
"""How many times the counted work the runs may actually take."""


@dataclass(slots=True)
class Refiner:
    """Runs a level at a rate, and at twice that again and again.

    A run that has to stop, for its steps are too long, counts for nothing.

    Attributes
    ----------
    level, values, wanted, target
        The run, the watched quantities, and the largest error they may have.
    stepping
        The stepping of the next run.
    refinement
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
    refinement: Refinement | None = None
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
            self._traces, self.refinement, self.failure = [], None, error
        if len(self._traces) > 1:
            self.refinement = judged(self._traces, self.wanted)
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
        """The rate from which its errors are small enough, as far as it shows [Hz]."""
        refinement = self.refinement
        if not refinement or len(self._traces) < FEWEST:
            return inf
        rate = refinement.rate_for(self.target) if refinement.believable(self.target) else inf
        return max(rate, SLOWEST) if rate <= HIGHEST_RATE else inf

    def lags(self, enough: float) -> bool:
        """Whether its remaining work is still unknown, and may be less than some work [s]."""
        return self.needed == inf and self.step * self.stepping.rate <= enough

    @property
    def promised(self) -> float:
        """What a second of the scene is expected to take that will do [s], as counted."""
        return self.step * self.needed


def refine(
    refiners: Sequence[Refiner], seconds: float, stop: Stop, progress: Progress | None = None
) -> list[Refinement]:
    """Take runs in turn, until the cheapest that will do is seen, or the work is done.

    Where bodies touch, the first is the judge of the others.

    Returns
    -------
    The refinements, each with errors held against the best, in the order of those that have any.

    Raises
    ------
    Cancelled
        If `stop` said so.
    """
    spent, begun = 0.0, thread_time()
    refinements: list[Refinement] = []
    while left := _worthwhile(refiners, refinements):
        next_ = min(left, key=lambda refiner: refiner.work(refiner.stepping.rate))
        work = next_.work(next_.stepping.rate)
        if spent + work > seconds or thread_time() - begun > PATIENCE * seconds:
            break
        if progress:
            progress(spent / seconds, f"{next_.stepping.scheme} at {next_.stepping.rate:g} Hz")
        spent += work
        next_.run(stop)
        refinements = held(refiners)
    return refinements


def held(refiners: Sequence[Refiner]) -> list[Refinement]:
    """Return all refinements with their errors against the best, the best first.

    None as long as there is but stock pymunk, which agrees with itself on what is wrong.
    """
    found = [refiner.refinement for refiner in refiners if refiner.refinement]
    judges = [refinement for refinement in found if not refinement.traces[0].stepping.is_stock]
    if not judges:
        return []
    best = min(judges, key=lambda refinement: refinement.errors[-1])
    if refiners[0].level.effects.contact:  # what sweeps still owe, only more of them show, or none
        plain = refiners[-1].stepping.at(HIGHEST_RATE)
        able = [found for found in judges if found.traces[0].stepping.at(HIGHEST_RATE) != plain]
        best = min(able or judges, key=lambda refinement: refinement.errors[-1])
    wanted = refiners[0].wanted
    others = [
        held_against(refinement, best, wanted) for refinement in found if refinement is not best
    ]
    return [best, *others]


def cost(refiners: Sequence[Refiner], refinement: Refinement) -> float:
    """Return how much work a step of a refinement is [s], as counted."""
    return next(
        c.step for c in refiners if c.refinement and c.refinement.traces is refinement.traces
    )


def _worthwhile(refiners: Sequence[Refiner], refinements: Sequence[Refinement]) -> list[Refiner]:
    """Return those that may still find something cheaper than what is seen to do.

    A run is as cheap as any finer one is not: it must be below what was found already.
    """
    left = [refiner for refiner in refiners if not refiner.over]
    target = refiners[0].target
    seen = [
        cost(refiners, refinement) * found[0].stepping.rate
        for refinement in refinements
        if (found := refinement.cheapest(target))
    ]
    least = min(seen, default=inf)
    left = [refiner for refiner in left if refiner.step * refiner.stepping.rate < least]
    if refiners[0].level.effects.contact:
        return left
    enough = DEARER * min(refiner.promised for refiner in refiners)
    return [refiner for refiner in left if refiner.promised <= enough or refiner.lags(enough)]
