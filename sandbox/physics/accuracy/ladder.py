"""Runs of one scheme with smaller and smaller steps, as far as the time goes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.estimation import Errors, extrapolated
from sandbox.physics.accuracy.runs import Stop, Watched, apart, record, scale, size
from sandbox.physics.errors import SimulationError
from sandbox.physics.trace import Trace

FEWEST = 3
"""Runs that must agree before anything is believed."""

OVERDRAFT = 2.0
"""How often the time for it may be spent while there are fewer than that."""

SLOWEST = 30.0
"""Hz, the lowest rate that is chosen: fewer steps look like none."""

FASTEST = 100_000.0
"""Hz, the highest rate that a level may have."""


@dataclass(frozen=True, slots=True)
class Ladder:
    """Runs of one scheme, each at twice the rate of the one before.

    Attributes
    ----------
    traces
        The runs.
    errors
        (r,), the largest relative error of each of them.
    growth
        For each quantity the error of the last run and the order by which it falls on.
    """

    traces: tuple[Trace, ...]
    errors: tuple[float, ...]
    growth: tuple[tuple[float, float | None], ...]

    def cheapest(self, error: float) -> tuple[Trace, float] | None:
        """Return the first run with no larger error, as runs with smaller steps say, and that.

        Where bodies touch, two such runs must agree: one can do so by chance.
        """
        witnesses = 2 if self.traces[0].level.effects.contact else 1
        runs = zip(self.traces[:-witnesses], self.errors, strict=False)
        return next((r for r in runs if r[1] <= error and r[0].stepping.rate >= SLOWEST), None)

    def rate_for(self, error: float) -> float:
        """Return the rate at which no error is expected to be larger [Hz]; infinite if none is."""
        rate = last = self.traces[-1].stepping.rate
        for off, order in self.growth:
            if off > error:
                rate = max(rate, last * (off / error) ** (1 / order) if order else inf)
        return rate

    def error_at(self, rate: float) -> float:
        """Return the largest error that is expected at a rate beyond the last [Hz]."""
        ratio = self.traces[-1].stepping.rate / rate
        return max((off * ratio ** (order or 0.0) for off, order in self.growth), default=inf)


def climb(
    level: Level,
    values: Values,
    stepping: Stepping,
    wanted: Sequence[Watched],
    target: float,
    seconds: float,
    stop: Stop,
) -> Ladder | None:
    """Run a level at a rate, and at twice that again and again, until one but the last will do.

    A run that has to stop, for its steps are too long, counts for nothing. None if the time does
    not reach for two that do not.

    Raises
    ------
    Cancelled
        If `stop` said so.
    SimulationError
        If all runs had to stop.
    """
    start = thread_time()
    traces: list[Trace] = []
    found = failure = None
    while stepping.rate <= FASTEST:
        begun = thread_time()
        try:
            traces.append(record(level, values, stepping, wanted, stop))
        except SimulationError as error:
            traces, failure = [], error
        now = thread_time()
        if len(traces) > 1:
            found = judged(traces, wanted)
            if len(traces) >= FEWEST and found.cheapest(target):
                break
        spent, next_ = now - start, 2 * (now - begun)
        if spent + next_ > (seconds if len(traces) >= FEWEST else OVERDRAFT * seconds):
            break
        stepping = stepping.model_copy(update={"rate": 2 * stepping.rate})
    if failure and not traces:
        raise failure
    return found


def judged(traces: Sequence[Trace], wanted: Sequence[Watched]) -> Ladder:
    """Return runs with their errors, as far as they tell them themselves."""
    last = traces[-1]
    found = [(item, errors) for item in wanted if (errors := extrapolated(traces, item))]
    parts = [_relative(errors, size(last, item)) for item, errors in found]
    worst = tuple(max(column) for column in zip(*(part.of for part in parts), strict=True))
    growth = tuple((part.of[-1], part.order) for part in parts)
    return Ladder(tuple(traces), worst or (inf,) * len(traces), growth)


def _relative(errors: Errors, largest: float) -> Errors:
    unit = scale(largest, errors.of[-1])
    return Errors(tuple(error / unit for error in errors.of), errors.order)


def held_against(ladder: Ladder, better: Ladder, wanted: Sequence[Watched]) -> Ladder:
    """Return a ladder with its errors against the last run of a better one."""
    last, own = better.traces[-1], better.errors[-1]
    errors = tuple(max(_off(trace, last, wanted) + own, own) for trace in ladder.traces)
    return replace(ladder, errors=errors)


def _off(trace: Trace, best: Trace, wanted: Sequence[Watched]) -> float:
    """Return the largest relative difference of two runs."""
    worst = 0.0
    for item in wanted:
        difference = apart(trace, best, item)
        if difference is not None:
            worst = max(worst, difference / scale(size(best, item), difference))
    return worst
