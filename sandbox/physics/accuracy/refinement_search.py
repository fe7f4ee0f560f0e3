"""The search over schemes and steps: which run comes next, within the work allowed.

The next run is always the one with the least work, so that no scheme uses up the time of the
others. A scheme that can no longer be the cheapest is dropped. Work is counted, so that the same
request takes the same runs; a clock only ends runs that take far longer than counted.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Scheme, Stepping
from sandbox.model.translatable_message import Message
from sandbox.physics.accuracy.chaos_detection import foretold
from sandbox.physics.accuracy.compared_runs import SEEN, Stop, Watched, record
from sandbox.physics.accuracy.counted_step_cost import LOOK, counted_cost
from sandbox.physics.accuracy.step_refinement import Refinement, held_against, judged, slowest
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError

Progress = Callable[[float, Message], None]
"""A callback with the share of the work that is done, and the next run with what is known so far.
"""

FEWEST = 3
"""The number of runs of a scheme before its remaining work is estimated."""

DEARER = 2.0
"""The ratio of work to that of another scheme from which a scheme is dropped."""

PATIENCE = 6.0
"""The longest time that the runs may actually take, as a multiple of the counted work; two runs to
compare are always taken."""


@dataclass(slots=True)
class Refiner:
    """Runs a level at a rate, and at twice the rate each next time.

    A run that has to stop because its steps are too long does not count.
    """

    level: Level
    values: Values
    """The run."""
    stepping: Stepping
    """The stepping of the next run."""
    wanted: Sequence[Watched]
    target: float
    """The watched quantities, and the largest error allowed."""
    refinement: Refinement | None = None
    """The runs so far; None if there are fewer than two."""
    known: Trace | None = None
    """A run that was taken before, and is not taken again."""
    failure: SimulationError | None = None
    """Why the last run had to stop; None if it did not."""
    step: float = 0.0
    """The counted work of a step [s]."""
    _traces: list[Trace] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.step = counted_cost(self.level, self.values, self.stepping)

    def run(self, stop: Stop) -> None:
        """Take the next run; raise `Cancelled` if `stop` returned true."""
        self.failure = None
        try:
            self._traces.append(self._next(stop))
        except SimulationError as error:
            self._traces, self.refinement, self.failure = [], None, error
        if len(self._traces) > 1:
            self.refinement = judged(self._traces, self.wanted)
        self.stepping = self.stepping.model_copy(update={"rate": 2 * self.stepping.rate})

    def _next(self, stop: Stop) -> Trace:
        if self.known and self.known.stepping == self.stepping:
            return self.known
        return record(self.level, self.values, self.stepping, self.wanted, stop)

    def work(self, rate: float) -> float:
        """Return the counted work of a run at a rate, even if it is known already [s]."""
        looks = min(rate, 2 * SEEN)
        return self.level.duration(self.values) * (rate * self.step + looks * LOOK)

    @property
    def over(self) -> bool:
        """Whether the highest rate has been passed."""
        return self.stepping.rate > HIGHEST_RATE

    @property
    def needed(self) -> float:
        """The rate from which its errors are small enough [Hz]; infinite if not known."""
        refinement = self.refinement
        if not refinement or len(self._traces) < FEWEST:
            return inf
        rate = refinement.rate_for(self.target) if refinement.believable(self.target) else inf
        return max(rate, slowest(self.stepping)) if rate <= HIGHEST_RATE else inf

    def lags(self, enough: float) -> bool:
        """Whether its remaining work is still unknown, and may be within some work [s]."""
        return self.needed == inf and self.step * self.stepping.rate <= enough

    @property
    def promised(self) -> float:
        """The counted work per second of the scene at the rate that is needed [s]."""
        return self.step * self.needed


def refine(
    refiners: Sequence[Refiner],
    seconds: float,
    stop: Stop,
    progress: Progress | None = None,
    begun: float | None = None,
    further: float = 0.0,
) -> list[Refinement]:
    """Run the schemes in turn until the cheapest sufficient run is known, or the work is spent.

    `begun` is the `thread_time` at which the search began, if that was earlier [s]. `further` is
    the work that is allowed beyond, where all is smooth and a run that will do is near. For a level
    with contacts, the first refiner is the reference for the others. Return the refinements, each
    with errors relative to the best, which comes first. Raises `Cancelled` if `stop` returned true.
    """
    spent, begun = 0.0, thread_time() if begun is None else begun
    refinements: list[Refinement] = []
    while left := _worthwhile(refiners, refinements):
        next_ = min(left, key=lambda refiner: refiner.work(refiner.stepping.rate))
        work = next_.work(next_.stepping.rate)
        late = thread_time() - begun > PATIENCE * seconds and refinements
        if late or spent + work > seconds + _beyond(refiners, refinements, further):
            break
        if progress:
            progress(spent / seconds, _told(next_.stepping, refinements, next_))
        spent += work
        next_.run(stop)
        refinements = held(refiners)
    return refinements


def _beyond(refiners: Sequence[Refiner], refinements: Sequence[Refinement], most: float) -> float:
    """Return the further work that is worthwhile where all is smooth and no run will do yet [s].

    It is that of confirming the most promising setting, as an extrapolation would have to be.
    """
    first = refiners[0]
    promised = 3 * min(refiner.promised for refiner in refiners)
    if not first.stepping.is_composed or promised == inf:
        return 0.0
    if any(found.cheapest(first.target) for found in refinements):
        return 0.0
    return min(promised * first.level.duration(first.values), most)


def at_rate(scheme: Scheme, rate: float) -> Message:
    """Return a scheme and its rate in words."""
    return Message("{scheme} at {rate:g} Hz", scheme=scheme, rate=rate)


def _told(stepping: Stepping, refinements: Sequence[Refinement], search: Refiner) -> Message:
    """Return a run in words, and how far the best runs before it agree."""
    now = at_rate(stepping.scheme, stepping.rate)
    if not refinements:
        return now
    until = foretold(refinements, search.wanted, search.target)
    return Message(
        "{now}; the error so far is {error:.1e}, predictable until t = {t:.3g} s",
        now=now,
        error=refinements[0].errors[-1],
        t=until,
    )


def held(refiners: Sequence[Refiner]) -> list[Refinement]:
    """Return all refinements with errors relative to the best, the best first.

    Empty if there is only stock pymunk, whose runs may agree on a wrong result.
    """
    found = [refiner.refinement for refiner in refiners if refiner.refinement]
    judges = [refinement for refinement in found if not refinement.traces[0].stepping.is_stock]
    if not judges:
        return []
    best = min(judges, key=lambda refinement: refinement.errors[-1])
    if refiners[0].level.effects.contact:  # only more sweeps, or none, show the error of sweeps
        plain = refiners[-1].stepping.at(HIGHEST_RATE)
        able = [found for found in judges if found.traces[0].stepping.at(HIGHEST_RATE) != plain]
        best = min(able or judges, key=lambda refinement: refinement.errors[-1])
    wanted = refiners[0].wanted
    others = [
        held_against(refinement, best, wanted) for refinement in found if refinement is not best
    ]
    return [best, *others]


def cost(refiners: Sequence[Refiner], refinement: Refinement) -> float:
    """Return the counted work of a step of a refinement [s]."""
    return next(
        c.step for c in refiners if c.refinement and c.refinement.traces is refinement.traces
    )


def _worthwhile(refiners: Sequence[Refiner], refinements: Sequence[Refinement]) -> list[Refiner]:
    """Return the refiners that may still find something cheaper than the best sufficient run.

    Finer runs only cost more, so the next run of a refiner must be below that run's work.
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
