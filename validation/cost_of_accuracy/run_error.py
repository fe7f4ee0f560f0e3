"""The error of a run: the largest of its checks.

A check's formula may be an approximation itself, as for small swings. No step is small enough to
come closer than that; such a check is compared with a much finer run instead.
"""

from contextlib import suppress
from dataclasses import dataclass
from math import inf
from time import perf_counter

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Check, Level, Stepping
from sandbox.physics.accuracy.compared_runs import SEEN, check_item, record
from sandbox.physics.measuring.grading import grade, least_scale, relative_error, samples
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.simulation_errors import SimulationError

ROUNDING = 1e-9
"""The error at a small step below which it is rounding, not an approximation."""

FALLS = 0.5
"""The largest ratio of errors, as the step falls to an eighth, for an error that vanishes."""


@dataclass(frozen=True, slots=True)
class Yardstick:
    """The references for the runs of a level."""

    own: Trace
    reference: Trace
    """A run at the level's own rate, and one with a small step; both are the same if only rounding
    remains at the former."""
    by_formula: tuple[int, ...]
    by_reference: tuple[int, ...]
    """The level's checks that are compared with their formulas, and those compared with that run.
    """

    @property
    def kind(self) -> str:
        """A description of the reference."""
        finer = f"a run at {self.reference.stepping.rate:g} Hz"
        if not self.by_reference:
            return "closed form"
        return f"closed form and {finer}" if self.by_formula else finer

    @property
    def quantities(self) -> tuple[str, ...]:
        """The compared quantities."""
        checks = self.reference.level.checks
        chosen = sorted((*self.by_formula, *self.by_reference))
        return tuple(dict.fromkeys(checks[i].quantity for i in chosen))

    def formula_error(self, trace: Trace) -> float:
        """Return the largest error from closed forms; infinite if an event never occurred."""
        results = grade(trace)
        errors = (results[i].error for i in self.by_formula)
        return max(np.inf if error is None else error for error in errors)

    def error(self, trace: Trace) -> float:
        """Return the largest error of a run; infinite if an event never occurred."""
        results = grade(trace)
        checks = trace.level.checks
        errors = [results[i].error for i in self.by_formula]
        errors += [_difference(checks[i], trace, self.reference) for i in self.by_reference]
        return max(np.inf if error is None else error for error in errors)


def yardstick(level: Level, values: Values, budget: float) -> Yardstick | None:
    """Return the references for a level's runs; None if no check applies.

    The finest run may take about the budget [s]. Raises `SimulationError` if the level does not run
    at its own rate.
    """
    start = perf_counter()
    coarse = fine = run(level, values, _at(level, level.stepping.rate))
    if any((result.error or 0.0) > ROUNDING for result in grade(coarse)):
        fine = _finer(level, values, coarse, perf_counter() - start, budget)
    by_formula: list[int] = []
    by_reference: list[int] = []
    for i, (before, after) in enumerate(zip(grade(coarse), grade(fine), strict=True)):
        if before.error is None or after.error is None:
            continue
        exact = after.error <= ROUNDING or after.error < FALLS * before.error
        (by_formula if exact else by_reference).append(i)
    if not (by_formula or by_reference):
        return None
    return Yardstick(coarse, fine, tuple(by_formula), tuple(by_reference))


def _at(level: Level, rate: float) -> Stepping:
    return Stepping(rate=rate, iterations=level.stepping.iterations)


def _finer(level: Level, values: Values, coarse: Trace, took: float, budget: float) -> Trace:
    """Return a run with a sixteenth of the step; or else an eighth, a quarter or a half.

    Given the time of the coarse run, it may take no longer than the budget [s]. Every step is
    observed, since other runs are compared with values between two observations.
    """
    rate = coarse.stepping.rate
    for times in (16, 8, 4):
        if times * took > budget:
            continue
        with suppress(SimulationError):
            return run(level, values, _at(level, times * rate), inf)
    return run(level, values, _at(level, 2 * rate), inf)


def run(level: Level, values: Values, stepping: Stepping, seen: float = SEEN) -> Trace:
    """Run a level and record what its checks need, at a rate [Hz] or up to twice that.

    An observation costs more than a step. But if a check is at an instant, every step is observed:
    interpolation between observations has an error that grows with their distance.
    """
    wanted = [check_item(check, values) for check in level.checks]
    instants = any(check.at is not None for check in level.checks)
    return record(level, values, stepping, wanted, observation_rate=inf if instants else seen)


def _difference(check: Check, trace: Trace, reference: Trace) -> float | None:
    found = samples(trace, check.quantity, check.at)
    wanted = samples(reference, check.quantity, check.at)
    if found is None or wanted is None:
        return None
    t, measured = found
    expected: Array = wanted[1] if check.at else np.interp(t, *wanted)
    return relative_error(measured, expected, least_scale(check, trace.values))[0]
