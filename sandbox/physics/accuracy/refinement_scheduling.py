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
from sandbox.physics.accuracy.chaos_detection import prediction_horizon
from sandbox.physics.accuracy.compared_runs import SEEN, Stop, Watched, record
from sandbox.physics.accuracy.counted_step_cost import LOOK, counted_cost
from sandbox.physics.accuracy.step_refinement import (
    Refinement,
    lowest_rate,
    relative_to,
    with_errors,
)
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.simulation_errors import SimulationError

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
    items: Sequence[Watched]
    target: float
    """The watched quantities, and the largest error allowed."""
    refinement: Refinement | None = None
    """The runs so far; None if there are fewer than two."""
    known_run: Trace | None = None
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
            self._traces.append(self._next_run(stop))
        except SimulationError as error:
            self._traces, self.refinement, self.failure = [], None, error
        if len(self._traces) > 1:
            self.refinement = with_errors(self._traces, self.items)
        self.stepping = self.stepping.model_copy(update={"rate": 2 * self.stepping.rate})

    def _next_run(self, stop: Stop) -> Trace:
        if self.known_run and self.known_run.stepping == self.stepping:
            return self.known_run
        return record(self.level, self.values, self.stepping, self.items, stop)

    def work(self, rate: float) -> float:
        """Return the counted work of a run at a rate, even if it is known already [s]."""
        looks = min(rate, 2 * SEEN)
        return self.level.duration(self.values) * (rate * self.step + looks * LOOK)

    @property
    def is_finished(self) -> bool:
        """Whether the highest rate has been passed."""
        return self.stepping.rate > HIGHEST_RATE

    @property
    def sufficient_rate(self) -> float:
        """The rate from which its errors are small enough [Hz]; infinite if not known."""
        refinement = self.refinement
        if not refinement or len(self._traces) < FEWEST:
            return inf
        rate = refinement.rate_for(self.target) if refinement.can_extrapolate(self.target) else inf
        return max(rate, lowest_rate(self.stepping)) if rate <= HIGHEST_RATE else inf

    def is_undecided(self, work: float) -> bool:
        """Whether its remaining work is still unknown, and may be within some work [s]."""
        return self.sufficient_rate == inf and self.step * self.stepping.rate <= work

    @property
    def work_expected(self) -> float:
        """The counted work per second of the scene at the rate that is needed [s]."""
        return self.step * self.sufficient_rate


def refine(
    refiners: Sequence[Refiner],
    seconds: float,
    stop: Stop,
    progress: Progress | None = None,
    started: float | None = None,
    extra_work: float = 0.0,
) -> list[Refinement]:
    """Run the schemes in turn until the cheapest sufficient run is known, or the work is spent.

    `started` is the `thread_time` at which the search began, if that was earlier [s]. `extra_work`
    is the work that is allowed beyond, where all is smooth and a run that will do is near. For a
    level with contacts, the first refiner is the reference for the others. Return the refinements,
    each with errors relative to the best, which comes first. Raises `Cancelled` if `stop` returned
    true.
    """
    spent, started = 0.0, thread_time() if started is None else started
    refinements: list[Refinement] = []
    while candidates := _worthwhile(refiners, refinements):
        next_ = min(candidates, key=lambda refiner: refiner.work(refiner.stepping.rate))
        work = next_.work(next_.stepping.rate)
        late = thread_time() - started > PATIENCE * seconds and refinements
        if late or spent + work > seconds + _extra_work(refiners, refinements, extra_work):
            break
        if progress:
            progress(spent / seconds, _progress_message(next_.stepping, refinements, next_))
        spent += work
        next_.run(stop)
        refinements = compared_with_best(refiners)
    return refinements


def _extra_work(
    refiners: Sequence[Refiner], refinements: Sequence[Refinement], limit: float
) -> float:
    """Return the further work that is worthwhile where all is smooth and no run will do yet [s].

    It is that of confirming the most promising setting, as an extrapolation would have to be.
    """
    first = refiners[0]
    expected = 3 * min(refiner.work_expected for refiner in refiners)
    if not first.stepping.is_composed or expected == inf:
        return 0.0
    if any(found.cheapest(first.target) for found in refinements):
        return 0.0
    return min(expected * first.level.duration(first.values), limit)


def at_rate(scheme: Scheme, rate: float) -> Message:
    """Return a scheme and its rate in words."""
    return Message("{scheme} at {rate:g} Hz", scheme=scheme, rate=rate)


def _progress_message(
    stepping: Stepping, refinements: Sequence[Refinement], search: Refiner
) -> Message:
    """Return a run in words, and how far the best runs before it agree."""
    now = at_rate(stepping.scheme, stepping.rate)
    if not refinements:
        return now
    horizon = prediction_horizon(refinements, search.items, search.target)
    return Message(
        "{now}; the error so far is {error:.1e}, predictable until t = {t:.3g} s",
        now=now,
        error=refinements[0].errors[-1],
        t=horizon,
    )


def compared_with_best(refiners: Sequence[Refiner]) -> list[Refinement]:
    """Return all refinements with errors relative to the best, the best first.

    Empty if there is only stock pymunk, whose runs may agree on a wrong result.
    """
    all_refinements = [refiner.refinement for refiner in refiners if refiner.refinement]
    references = [
        refinement for refinement in all_refinements if not refinement.traces[0].stepping.is_stock
    ]
    if not references:
        return []
    best = min(references, key=lambda refinement: refinement.errors[-1])
    if refiners[0].level.effects.contact:  # only more sweeps, or none, show the error of sweeps
        plain = refiners[-1].stepping.at(HIGHEST_RATE)
        able = [
            all_refinements
            for all_refinements in references
            if all_refinements.traces[0].stepping.at(HIGHEST_RATE) != plain
        ]
        best = min(able or references, key=lambda refinement: refinement.errors[-1])
    items = refiners[0].items
    others = [
        relative_to(refinement, best, items)
        for refinement in all_refinements
        if refinement is not best
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
    candidates = [refiner for refiner in refiners if not refiner.is_finished]
    target = refiners[0].target
    sufficient = [
        cost(refiners, refinement) * found[0].stepping.rate
        for refinement in refinements
        if (found := refinement.cheapest(target))
    ]
    cheapest = min(sufficient, default=inf)
    candidates = [
        refiner for refiner in candidates if refiner.step * refiner.stepping.rate < cheapest
    ]
    if refiners[0].level.effects.contact:
        return candidates
    allowed = DEARER * min(refiner.work_expected for refiner in refiners)
    return [
        refiner
        for refiner in candidates
        if refiner.work_expected <= allowed or refiner.is_undecided(allowed)
    ]
