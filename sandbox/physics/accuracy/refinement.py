"""Runs of one scheme with smaller and smaller steps, and what they tell of others."""

from bisect import bisect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import ceil, floor, inf, log2, log10

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.accuracy.richardson import ORDERS, extrapolated
from sandbox.physics.accuracy.runs import Watched, apart, scale, size
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.stepping.making import make_world

NEARLY = 0.75
"""The share of its order that a scheme shows where its steps are small enough for it."""

WORTHWHILE = 0.9
"""The share of a rate, at the most, to which it is worth while to lower it."""

SLOWEST = 30.0
"""Hz, the lowest rate that is chosen: fewer steps look like none."""


def foot(rate: float) -> float:
    """Return the rate from which doubling leads to a level's own: the lowest not below `SLOWEST`.

    >>> foot(1000.0)
    31.25
    """
    return rate / 2 ** floor(log2(max(rate, SLOWEST) / SLOWEST))


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
        For each quantity the error of the last run and the power of the step by which it goes on:
        less than zero where it is rounding, which grows with the rate.
    """

    traces: tuple[Trace, ...]
    errors: tuple[float, ...]
    growth: tuple[tuple[float, float], ...]

    def cheapest(self, error: float) -> tuple[Trace, float] | None:
        """Return the first run with no larger error, as runs with smaller steps say, and that.

        Where bodies touch, two such runs must agree: one can do so by chance.
        """
        witnesses = 2 if self._contact else 1
        runs = zip(self.traces[:-witnesses], self.errors, strict=False)
        return next((r for r in runs if r[1] <= error and r[0].stepping.rate >= SLOWEST), None)

    def between(self, error: float) -> float | None:
        """Return a rate below the first run that will do, at which one might do as well [Hz].

        It is on the power of the rate through that run and the one before; None if that is none of
        the scheme's, as where bodies touch: there errors jump about.
        """
        found = self.cheapest(error)
        if not found or found[0] is self.traces[0]:
            return None
        rate, little = found[0].stepping.rate, found[1]
        much = self.errors[self.traces.index(found[0]) - 1]
        if much <= error:
            return SLOWEST if rate > SLOWEST else None
        order = ORDERS[self.traces[-1].stepping.scheme]
        if self._contact or not 0 < little < error < much < little * 2 ** (2 * order):
            return None
        lower = rounded(rate * (little / error) ** (1 / log2(much / little)))
        return max(lower, SLOWEST) if lower < WORTHWHILE * rate else None

    def joined(self, trace: Trace, wanted: Sequence[Watched]) -> "Ladder":
        """Return the same with one run more, at a rate between."""
        rates = [other.stepping.rate for other in self.traces]
        at = bisect(rates, trace.stepping.rate)
        error = _off(trace, self.traces[-1], wanted) + self.errors[-1]
        traces = (*self.traces[:at], trace, *self.traces[at:])
        return replace(self, traces=traces, errors=(*self.errors[:at], error, *self.errors[at:]))

    @property
    def _contact(self) -> bool:
        return bool(self.traces[0].level.effects.contact)

    def believable(self, target: float) -> bool:
        """Whether it tells how far there is to go to an error.

        Of fourth order it has to show that: a lower one would ask for far too many steps.
        """
        scheme = self.traces[-1].stepping.scheme
        shown = NEARLY * ORDERS[scheme] if scheme == "fourth-order" else -inf
        return all(order >= shown for off, order in self.growth if off > target)

    def rate_for(self, error: float) -> float:
        """Return the rate at which no error is expected to be larger [Hz]; infinite if none is.

        What pymunk makes of impacts as it comes is a matter of chance, and nothing follows from it.
        """
        if self.traces[-1].stepping.as_it_comes:
            return inf
        rate = last = self.traces[-1].stepping.rate
        for off, order in self.growth:
            if off > error:
                rate = max(rate, last * (off / error) ** (1 / order) if order > 0 else inf)
        return rate

    def error_at(self, rate: float) -> float:
        """Return the largest error that is expected at a rate beyond the last [Hz]."""
        if self.traces[-1].stepping.as_it_comes:
            return inf
        ratio = self.traces[-1].stepping.rate / rate
        return max((off * ratio**order for off, order in self.growth), default=inf)


def step_prices(level: Level, values: Values, ladders: Iterable[Ladder]) -> tuple[float, ...]:
    """Return what a step of each ladder costs [s], at its highest rate."""
    steppings = (ladder.traces[-1].stepping for ladder in ladders)
    return brief_costs(*(partial(make_world, level, values, stepping) for stepping in steppings))


def judged(traces: Sequence[Trace], wanted: Sequence[Watched]) -> Ladder:
    """Return runs with their errors, as far as they tell them themselves."""
    parts = [errors for item in wanted if (errors := extrapolated(traces, item))]
    worst = tuple(max(column) for column in zip(*(part.relative for part in parts), strict=True))
    growth = tuple((part.relative[-1], part.order or -part.rise) for part in parts)
    return Ladder(tuple(traces), worst or (inf,) * len(traces), growth)


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


def rounded(rate: float) -> float:
    """Return a rate rounded up to three digits [Hz]."""
    if rate == inf:
        return rate
    unit = 10.0 ** (ceil(log10(rate)) - 3)
    return ceil(rate / unit) * unit
