"""Step refinement: runs of one scheme with smaller and smaller steps, and their extrapolation."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import ceil, floor, inf, log2

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.compared_runs import (
    Watched,
    error_scale,
    item_scale,
    largest_difference,
)
from sandbox.physics.accuracy.event_timing_errors import hidden_error
from sandbox.physics.accuracy.richardson_extrapolation import Errors, extrapolated
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.stepping.make_world import make_world

NEARLY = 0.75
"""The share of its order that a scheme must show to count as converging."""

PARTS = 4
"""The number of rates per octave: rates in ratios of small whole numbers share many instants, at
which their runs can be compared."""

WITNESSES = 2
"""How many finer runs of the same scheme confirm a run; one is enough where the runs show the order
of the scheme."""

RUNS = 4
"""The least number of runs that show an order."""

COUNTS = 0.1
"""The share of the largest error above which an error must show the order."""

ROUNDING = 1e-12
"""The relative tolerance within which rates count as equal."""

SPARE = 0.8
"""The share of the target error that a rate between two runs aims at."""

SMOOTH = 30.0
"""The lowest rate of a motion that is drawn [Hz]: in fewer steps it would look jerky."""


def lowest_doubled_rate(rate: float) -> float:
    """Return the rate from which doubling reaches a level's own: the lowest not below `SMOOTH`.

    >>> foot(1000.0)
    31.25
    """
    return rate / 2 ** floor(log2(max(rate, SMOOTH) / SMOOTH))


def octaves(stepping: Stepping) -> int:
    """Return by how many octaves below `SMOOTH` a scheme may be chosen.

    A step of a composed scheme has more than 2 to this power kicks, so that any run has at least
    `SMOOTH` kicks a second.
    """
    return stepping.order // 2 if stepping.is_composed else 0


def lowest_rate(stepping: Stepping) -> float:
    """Return the lowest rate that is chosen for a scheme [Hz]."""
    return SMOOTH / 2 ** octaves(stepping)


@dataclass(frozen=True, slots=True)
class Refinement:
    """Runs of one scheme, each at twice the rate of the one before."""

    traces: tuple[Trace, ...]
    """The runs."""
    errors: tuple[float, ...]
    """(r,), the largest relative error of each run."""
    growth: tuple[tuple[float, float], ...]
    """For each quantity the error of the last run, and the power of the step with which it
    continues: negative for rounding, which grows with the rate."""
    confirmed: int = 0
    """The number of runs, from the first, whose errors are confirmed by finer runs."""
    own_error: float | None = None
    """The error of the last run as estimated from these runs alone, which counts beside that
    relative to a better refinement; None if it does not."""

    def cheapest(self, error: float) -> tuple[Trace, float] | None:
        """Return the first run with a confirmed error that is small enough, and that error."""
        runs = zip(self.traces[: self.confirmed], self.errors, strict=False)
        lowest = lowest_rate(self.traces[0].stepping)
        return next((r for r in runs if r[1] <= error and r[0].stepping.rate >= lowest), None)

    def rate_between(self, error: float) -> float | None:
        """Return a rate below the first sufficient run at which the error may still suffice [Hz].

        It is interpolated by a power law through that run and the one before, and divides an octave
        in a ratio of small integers; None if there is none.
        """
        found = self.cheapest(error)
        if not found or found[0] is self.traces[0]:
            return None
        at = self.traces.index(found[0])
        low, high = (trace.stepping.rate for trace in self.traces[at - 1 : at + 1])
        fine_error, coarse_error = found[1], self.errors[at - 1]
        if not 0 < fine_error < SPARE * error < coarse_error < fine_error * 2 ** (2 * self._order):
            return None
        power = log2(coarse_error / fine_error) / log2(high / low)
        rate = high * (fine_error / (SPARE * error)) ** (1 / power)
        shared = shared_rate(rate, low)
        return shared if lowest_rate(found[0].stepping) <= shared < high else None

    @property
    def _order(self) -> int:
        return self.traces[-1].stepping.order

    def can_extrapolate(self, target: float) -> bool:
        """Whether the runs allow extrapolation to a smaller error.

        They have to show the order of the scheme: a lower order would ask for far too many steps.
        """
        shown = NEARLY * self._order
        return all(order >= shown for error, order in self.growth if error > target)

    def rate_for(self, error: float) -> float:
        """Return the rate from which no error is expected to be larger [Hz]; infinite if none.

        Nothing can be extrapolated for stock pymunk, whose impacts are a matter of chance.
        """
        if self.traces[-1].stepping.is_stock:
            return inf
        rate, last = 0.0, self.traces[-1].stepping.rate
        for last_error, order in self.growth:
            if order > 0:
                rate = max(rate, last * (last_error / error) ** (1 / order))
            elif last_error > error:
                return inf
        return rate

    def error_at(self, rate: float) -> float:
        """Return the largest error that is expected at a rate [Hz]."""
        if self.traces[-1].stepping.is_stock:
            return inf
        ratio = self.traces[-1].stepping.rate / rate
        return max((error * ratio**order for error, order in self.growth), default=inf)


def step_durations(level: Level, values: Values, *steppings: Stepping) -> tuple[float, ...]:
    """Return the time of a step with each stepping [s], measured in turn."""
    return brief_costs(*(partial(make_world, level, values, stepping) for stepping in steppings))


def with_errors(traces: Sequence[Trace], items: Sequence[Watched]) -> Refinement:
    """Return runs with their errors, estimated from the runs themselves."""
    parts = [errors for item in items if (errors := extrapolated(traces, item))]
    unseen = hidden_error(traces[-1], items).error
    largest = tuple(
        max(unseen, *column) for column in zip(*(part.relative for part in parts), strict=True)
    )
    contact = traces[0].level.effects.contact
    late = contact is not None and any(hidden_error(trace, items).error for trace in traces)
    growth = tuple((part.relative[-1], _power(part, are_late=late)) for part in parts)
    growth += ((unseen, 1.0),) if unseen else ()
    confirmed = max(len(traces) - WITNESSES, 0)
    refinement = Refinement(tuple(traces), largest or (inf,) * len(traces), growth, confirmed)
    shown = len(traces) >= RUNS and refinement.can_extrapolate(COUNTS * refinement.errors[-1])
    return replace(refinement, confirmed=confirmed + 1) if shown and not contact else refinement


def _power(errors: Errors, *, are_late: bool) -> float:
    """Return the power of the step with which the error of the last run continues.

    Where any run found impacts late, two runs that agree by chance show no order: the next run may
    be as far off as the last but one.
    """
    power = errors.order or -errors.rounding_growth
    return min(power, 1.0) if are_late and errors.agrees_by_chance else power


def relative_to(refinement: Refinement, better: Refinement, items: Sequence[Watched]) -> Refinement:
    """Return a refinement with its errors relative to the last run of a better one.

    The errors of all its runs are confirmed if the other scheme differs; else only those of runs
    with at least four times the step of that last run. Where all is smooth, three runs show their
    errors by themselves, too, and the larger estimate counts: the last run of the better scheme may
    seem more accurate than it is.
    """
    last, own = better.traces[-1], better.errors[-1]
    errors = tuple(
        max(largest_relative_difference(trace, last, items)[0] + own, own)
        for trace in refinement.traces
    )
    own_error = None
    if len(errors) > 2 and not last.level.effects.contact:
        own_error = refinement.errors[-1]
        errors = tuple(max(pair) for pair in zip(errors, refinement.errors, strict=True))
    finest = last.stepping.rate / 2**WITNESSES
    same_scheme = last.stepping.scheme == refinement.traces[-1].stepping.scheme
    confirmed = sum(not same_scheme or trace.stepping.rate <= finest for trace in refinement.traces)
    return replace(refinement, errors=errors, confirmed=confirmed, own_error=own_error)


def largest_relative_difference(
    trace: Trace, best: Trace, items: Sequence[Watched]
) -> tuple[float, Watched | None]:
    """Return the largest relative difference between two runs, and the quantity that has it."""
    largest: tuple[float, Watched | None] = 0.0, None
    for item in items:
        difference = largest_difference(trace, best, item)
        if difference is not None:
            relative = difference / error_scale(item_scale(best, item), difference)
            largest = max(largest, (relative, item), key=lambda found: found[0])
    return largest


def shared_rate(rate: float, other: float, parts: int = PARTS) -> float:
    """Return the lowest rate that is not below one [Hz] and shares many instants with another.

    It is the other rate, doubled or halved repeatedly, plus a number of equal parts of an octave.

    >>> in_step(100.0, 30.0)
    105.0
    """
    octave = other * 2.0 ** floor(log2(rate / other))
    return octave * ceil(parts * rate / octave * (1 - ROUNDING)) / parts
