"""Candidate settings from the refinements of a level, with their errors and costs."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import floor
from typing import NamedTuple

from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.model.translatable_message import Message
from sandbox.physics.accuracy.compared_runs import Watched, stride
from sandbox.physics.accuracy.event_timing_errors import hidden_error
from sandbox.physics.accuracy.refinement_scheduling import at_rate
from sandbox.physics.accuracy.step_refinement import (
    PARTS,
    SMOOTH,
    Refinement,
    largest_relative_difference,
    lowest_rate,
    shared_rate,
    step_durations,
)
from sandbox.physics.measuring.recording import Trace

REAL_TIME = 0.5
"""The computing time per second of the scene, at most [s]; the rest is for drawing."""

CAUTION = 0.7
"""The share of the accuracy that a setting may use where its error is extrapolated."""

NOT_SEEN = 1e-3
"""The least share by which an unconfirmed error exceeds the target: too few finer runs exist."""


@dataclass(frozen=True, slots=True)
class Offer:
    """A setting that is available, with its estimated error and its cost."""

    stepping: Stepping
    """The setting."""
    error: float
    """The largest error of the run, as for a check: relative, absolute if zero is expected."""
    cost: float
    """The computing time per second of the scene [s]."""

    def __str__(self) -> str:
        return str(self.in_words)

    @property
    def at_drawing_rate(self) -> "Offer":
        """The offer at a rate at which the motion does not look jerky; its error is no larger."""
        rate = max(self.stepping.rate, SMOOTH)
        return Offer(self.stepping.at(rate), self.error, self.cost * rate / self.stepping.rate)

    @property
    def in_words(self) -> Message:
        """The setting and its cost, in words."""
        s = self.stepping
        setting = at_rate(s.scheme, s.rate)
        if s.solver == "direct":
            setting = Message(
                "{scheme} at {rate:g} Hz, contacts solved directly", scheme=s.scheme, rate=s.rate
            )
        return Message(
            "{setting}, estimated error {error:.1e}, {cost:.3g} ms of computing per second of"
            " the scene",
            setting=setting,
            error=self.error,
            cost=self.cost * 1e3,
        )


class Candidate(NamedTuple):
    """A setting whose cost is not measured yet."""

    stepping: Stepping
    error: float
    """the largest error that is expected of the run"""
    trace: Trace | None
    """the run in which the error was measured; None if it is extrapolated by the order"""
    work: float
    """the counted work per second of the scene [s]"""
    decided_by: str = ""
    """the quantity with the largest error, if that was not found in the trace"""

    def offer(self, step: float) -> Offer:
        """Return the offer for it, given the cost of a step [s]."""
        return Offer(self.stepping, self.error, step * self.stepping.rate)


@dataclass(frozen=True, slots=True)
class Offers:
    """The settings that the refined schemes offer."""

    refinements: Sequence[Refinement]
    """Refined runs; the first refinement is the reference for the others."""
    work: Sequence[float]
    """The counted work of a step of each [s], by which the cheapest is chosen."""

    @property
    def without_stock(self) -> "Offers":
        """The settings that are not stock pymunk's."""
        pairs = zip(self.refinements, self.work, strict=True)
        left = [(found, work) for found, work in pairs if not found.traces[0].stepping.is_stock]
        return Offers(*zip(*left, strict=True))

    @property
    def fine(self) -> Trace:
        """A run nearly as accurate as the best, at half its cost."""
        return self.refinements[0].traces[-2]

    def best(self, target: float) -> Candidate:
        """Return the cheapest setting that reaches a target, or else the most accurate."""

        def rank(found: Candidate) -> tuple[float, bool, float]:
            return max(found.error, target), found.trace is None, found.work

        pairs = zip(self.refinements, self.work, strict=True)
        return min((_candidate(work, refinement, target) for refinement, work in pairs), key=rank)

    def measured(self, target: float) -> Candidate:
        """Return the most accurate run that misses a target, with its measured error.

        It is one of which all steps were compared, if there is any.
        """
        runs = [
            (error, trace, work)
            for refinement, work in zip(self.refinements, self.work, strict=True)
            for trace, error in zip(refinement.traces, refinement.errors, strict=True)
        ]
        whole = [run for run in runs if stride(run[1].stepping.rate) == 1]
        error, trace, work = min(whole or runs, key=lambda run: run[0])
        return _missed(trace, error, target, work)

    def in_real_time(self, steps: Sequence[float]) -> Offer | None:
        """Return the most accurate setting that runs in real time, given the cost of a step."""
        pairs = zip(self.refinements, steps, strict=True)
        found = (offer for refinement, step in pairs for offer in _in_real_time(step, refinement))
        return min(found, key=lambda offer: offer.error, default=None)

    def deciding_quantity(self, found: Candidate, items: Sequence[Watched]) -> str:
        """Return the quantity with the largest error in a setting's run, or in the nearest run."""
        *_, last_but_one, best = self.refinements[0].traces
        trace = found.trace or self._nearest(found.stepping)
        unseen = hidden_error(best, items)
        for run in (trace, last_but_one):  # the finest does not differ from itself
            worst = max(
                largest_relative_difference(run, best, items), unseen, key=lambda off: off[0]
            )
            if worst[1] is not None:
                return worst[1].quantity
        return ""

    def _nearest(self, stepping: Stepping) -> Trace:
        """Return the finest run of a scheme."""
        last = (refinement.traces[-1] for refinement in self.refinements)
        return next(trace for trace in last if trace.stepping.at(stepping.rate) == stepping)


@dataclass(frozen=True, slots=True)
class SearchResult:
    """The cheapest setting or, if none will do, the most accurate, and the runs behind it."""

    level: Level
    values: Values
    target: float
    items: Sequence[Watched]
    offers: Offers
    chosen: Candidate

    @property
    def decided_by(self) -> str:
        """The quantity with the largest error; empty if no quantity has any."""
        return self.chosen.decided_by or self.offers.deciding_quantity(self.chosen, self.items)

    def timed(self) -> Offer:
        """Return the setting with its cost, which is timed."""
        return self.chosen.offer(*step_durations(self.level, self.values, self.chosen.stepping))

    def in_real_time(self) -> Offer | None:
        """Return the most accurate setting that runs in real time."""
        last = [refinement.traces[-1].stepping for refinement in self.offers.refinements]
        return self.offers.in_real_time(step_durations(self.level, self.values, *last))


def _candidate(work: float, refinement: Refinement, target: float) -> Candidate:
    """Return a refinement's cheapest setting, or its best, given the work of a step [s]."""
    last = refinement.traces[-1].stepping
    if good := refinement.cheapest(target):
        trace, error = good
        return Candidate(trace.stepping, error, trace, work * trace.stepping.rate)
    if refinement.can_extrapolate(target):
        parts = 1 if refinement.traces[0].level.effects.contact else PARTS
        needed = min(
            max(refinement.rate_for(target * CAUTION), lowest_rate(last)), 2 * HIGHEST_RATE
        )
        rate = shared_rate(needed, last.rate, parts)
        if rate <= HIGHEST_RATE:
            return Candidate(last.at(rate), refinement.error_at(rate), None, work * rate)
    runs = zip(refinement.traces, refinement.errors, strict=True)
    trace, error = min(runs, key=lambda run: run[1])
    return _missed(trace, error, target, work)


def _missed(trace: Trace, error: float, target: float, work: float) -> Candidate:
    """Return a run as a setting that misses a target, given the work of a step [s]."""
    error = max(error, target * (1 + NOT_SEEN))
    return Candidate(trace.stepping, error, trace, work * trace.stepping.rate)


def _in_real_time(step: float, refinement: Refinement) -> Iterator[Offer]:
    """Yield a refinement's settings that run in real time, given the cost of a step [s]."""
    fastest = REAL_TIME / max(step, REAL_TIME / HIGHEST_RATE)
    for trace, error in zip(refinement.traces, refinement.errors, strict=True):
        if SMOOTH <= trace.stepping.rate <= fastest:
            yield Offer(trace.stepping, error, step * trace.stepping.rate)
    last = refinement.traces[-1].stepping
    if fastest > last.rate:
        rate = float(floor(fastest))
        setting = last.model_copy(update={"rate": rate})
        yield Offer(setting, refinement.error_at(rate), step * rate)
