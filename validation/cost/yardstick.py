"""What the error of a run is: the largest of its checks.

A check's formula may be an approximation itself, such as that of small swings. No step, however
small, comes closer to it than that; such a check is held against a much finer run instead.
"""

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Check, Level, Stepping
from sandbox.physics.checks import grade, relative_error, samples
from sandbox.physics.errors import SimulationError
from sandbox.physics.trace import Trace, simulate

ROUNDING = 1e-9
"""An error below this, at a small step, is no approximation's."""

FALLS = 0.5
"""The share to which an error must fall, at least, as the step falls to an eighth."""


@dataclass(frozen=True, slots=True)
class Yardstick:
    """What the runs of a level are held against.

    Attributes
    ----------
    reference
        A run with a small step.
    by_formula, by_reference
        The checks of the level that are held against their formulas, and against that run.
    """

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
        What is run.
    budget
        How long the finest run may take, about [s].

    Raises
    ------
    SimulationError
        If the level does not run at its own rate.
    """
    coarse = simulate(level, values, stepping=_at(level, level.stepping.rate))
    fine = _finer(level, values, coarse, budget)
    by_formula: list[int] = []
    by_reference: list[int] = []
    for i, (before, after) in enumerate(zip(grade(coarse), grade(fine), strict=True)):
        if before.error is None or after.error is None:
            continue
        exact = after.error <= ROUNDING or after.error < FALLS * before.error
        (by_formula if exact else by_reference).append(i)
    if not (by_formula or by_reference):
        return None
    return Yardstick(fine, tuple(by_formula), tuple(by_reference))


def _at(level: Level, rate: float) -> Stepping:
    return Stepping(rate=rate, iterations=level.stepping.iterations)


def _finer(level: Level, values: Values, coarse: Trace, budget: float) -> Trace:
    """Return the finest run that the budget allows: 16 times finer, or else 8, 4 or 2 times."""
    start = perf_counter()
    finer = simulate(level, values, stepping=_at(level, 2 * coarse.stepping.rate))
    seconds = perf_counter() - start
    for times in (16, 8, 4):
        if seconds * times / 2 > budget:
            continue
        try:
            return simulate(level, values, stepping=_at(level, times * coarse.stepping.rate))
        except SimulationError:
            continue
    return finer


def _difference(check: Check, trace: Trace, reference: Trace) -> float | None:
    found = samples(trace, check.quantity, check.at)
    wanted = samples(reference, check.quantity, check.at)
    if found is None or wanted is None:
        return None
    t, measured = found
    expected: Array = wanted[1] if check.at else np.interp(t, *wanted)
    return relative_error(measured, expected)[0]
