"""The error of a run: the largest of its checks.

A check's formula may be an approximation itself, such as that of small swings. No step, however
small, comes closer to it than that; such a check is held against a much finer run instead.
"""

from contextlib import suppress
from dataclasses import dataclass
from math import inf
from time import perf_counter

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Check, Level, Stepping
from sandbox.physics.accuracy.compared_runs import SEEN, by_check, record
from sandbox.physics.measuring.grading import grade, least_scale, relative_error, samples
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError

ROUNDING = 1e-9
"""An error below this at a small step is rounding, not an approximation."""

FALLS = 0.5
"""The share to which an error must fall as the step falls to an eighth."""


@dataclass(frozen=True, slots=True)
class Yardstick:
    """What the runs of a level are held against.

    Attributes
    ----------
    own, reference
        A run at the level's own rate, and one with a small step; the same where that leaves nothing
        but rounding.
    by_formula, by_reference
        The checks of the level that are held against their formulas, and against that run.
    """

    own: Trace
    reference: Trace
    by_formula: tuple[int, ...]
    by_reference: tuple[int, ...]

    @property
    def kind(self) -> str:
        """What it is, in words."""
        finer = f"a run at {self.reference.stepping.rate:g} Hz"
        if not self.by_reference:
            return "closed form"
        return f"closed form and {finer}" if self.by_formula else finer

    @property
    def quantities(self) -> tuple[str, ...]:
        """What is compared."""
        checks = self.reference.level.checks
        chosen = sorted((*self.by_formula, *self.by_reference))
        return tuple(dict.fromkeys(checks[i].quantity for i in chosen))

    def formula_error(self, trace: Trace) -> float:
        """Return the largest error against the closed forms; infinite if an event never came."""
        results = grade(trace)
        errors = (results[i].error for i in self.by_formula)
        return max(np.inf if error is None else error for error in errors)

    def error(self, trace: Trace) -> float:
        """Return the largest error of a run; infinite if an event never came."""
        results = grade(trace)
        checks = trace.level.checks
        errors = [results[i].error for i in self.by_formula]
        errors += [_difference(checks[i], trace, self.reference) for i in self.by_reference]
        return max(np.inf if error is None else error for error in errors)


def yardstick(level: Level, values: Values, budget: float) -> Yardstick | None:
    """Return what a level's runs can be held against; None if no check applies.

    Parameters
    ----------
    level, values
        The run.
    budget
        How long the finest run may take, about [s].

    Raises
    ------
    SimulationError
        If the level does not run at its own rate.
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

    The coarse one took so long, and it may take no longer than its budget [s]. Every step is looked
    at, for others are held against what lies between two looks.
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

    A look costs more than a step. But if a check asks for an instant, every step is looked at: what
    lies between two looks is off by how far they are apart.
    """
    wanted = [by_check(check, values) for check in level.checks]
    instants = any(check.at is not None for check in level.checks)
    return record(level, values, stepping, wanted, seen=inf if instants else seen)


def _difference(check: Check, trace: Trace, reference: Trace) -> float | None:
    found = samples(trace, check.quantity, check.at)
    wanted = samples(reference, check.quantity, check.at)
    if found is None or wanted is None:
        return None
    t, measured = found
    expected: Array = wanted[1] if check.at else np.interp(t, *wanted)
    return relative_error(measured, expected, least_scale(check, trace.values))[0]
