"""Grading a run by the closed forms of its level."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.level import Check, ContactEvent, Instant, SeparationEvent
from sandbox.model.measuring_instants import Passage, crossing_of
from sandbox.physics.measuring.interpolation_between_steps import crossing, value_at, value_before
from sandbox.physics.measuring.recording import Meeting, Trace

Verdict = Literal["passed", "failed", "waiting", "not applicable"]

ROUNDING = 1e-12
"""A run reaches the time of a check if it falls short of it by less than this share."""

ZERO = 1e-9
"""An expected value below this, in its SI unit, counts as zero: its error is then absolute."""


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a check."""

    check: Check
    unit: str
    """The unit of the measured and the expected value."""
    t: float | None
    """The time at which the two differed most, or the time of the event [s]; None without either.
    Of a contact too late in the run to measure anything after it, only the time is known."""
    measured: float | None
    expected: float | None
    """The two values at that time; None if there are none."""
    error: float | None
    """The largest difference over the largest expected value; absolute, in the unit, if that is
    zero. None if there is none."""
    verdict: Verdict
    """`waiting` if the run has not reached the time or event yet, `not applicable` if the check's
    own condition says that its formula does not hold here."""


def grade(trace: Trace) -> tuple[Result, ...]:
    """Grade a run by all the checks of its level."""
    return tuple(grade_check(check, trace) for check in trace.level.checks)


def relative_error(measured: Array, expected: Array, least_scale: float = 0.0) -> tuple[float, int]:
    """Return the largest difference, relative if possible, and its index.

    It is relative to the largest expected value, or to a least scale if that is larger. If all
    expected values are zero and there is no such scale, the error is absolute. A difference that is
    not a number is an infinite error.
    """
    with np.errstate(invalid="ignore"):
        difference = np.abs(measured - expected)
    difference = np.where(np.isnan(difference), np.inf, difference)
    worst = int(np.argmax(difference))
    scale = max(float(np.abs(expected).max()), least_scale)
    return float(difference[worst]) / (scale if ZERO < scale < np.inf else 1.0), worst


def grade_check(check: Check, trace: Trace) -> Result:
    """Grade a run by one check, from the recorded quantities that it needs."""
    unit = trace.units[check.quantity]
    if not applies(check, trace.values):
        return Result(check, unit, None, None, None, None, "not applicable")
    found = samples(trace, check.quantity, check.at)
    if found is None:
        return Result(check, unit, _began(trace, check.at), None, None, None, "waiting")
    t, measured = found
    try:
        expected = check.formula.over(trace.values, t)
    except ExpressionError:
        expected = np.full_like(t, np.nan)
    error, worst = relative_error(measured, expected, least_scale(check, trace.values))
    return Result(
        check,
        unit,
        float(t[worst]),
        float(measured[worst]),
        float(expected[worst]),
        error,
        "passed" if error <= check.tolerance else "failed",
    )


def least_scale(check: Check, values: Values) -> float:
    """Return the least scale of a check's errors; 0 if it gives none."""
    return check.scale(values) if check.scale else 0.0


def applies(check: Check, values: Values) -> bool:
    """Return whether a check's own condition says that its formula holds for the parameters."""
    if check.valid_if is None:
        return True
    try:
        return bool(check.valid_if.over(values, np.zeros(()))[()])
    except ExpressionError:
        return False


def samples(trace: Trace, quantity: str, at: Instant | None) -> tuple[Array, Array] | None:
    """Return the times that count and the values there; None if the run has not reached them.

    Without a time or an event, every step counts. The run must have recorded the quantity, and
    those that `needed` names for the instant.
    """
    column = trace.columns[quantity]
    if at is None:
        # Euler's schemes yield no forces before the first step
        first = 1 if trace.stepping.is_stock else 0
        return (trace.t[first:], column[first:]) if len(trace.t) > first else None
    if isinstance(at, ContactEvent):
        return _after_contact(trace, column, at)
    if isinstance(at, SeparationEvent):
        return _when_parted(trace, column, at)
    time = time_of(at, trace)
    if time is None:
        return None
    value = value_at(trace.t, column, time, smooth=trace.smooth)
    return np.array([time]), np.array([value])


def _began(trace: Trace, at: Instant | None) -> float | None:
    """Return when a contact began [s]; None if it has not, or for anything else."""
    meeting = _meeting(trace, at) if isinstance(at, ContactEvent) else None
    if meeting is None:
        return None
    return float(trace.t[meeting.step]) if meeting.time is None else meeting.time


def _meeting(trace: Trace, at: ContactEvent) -> Meeting | None:
    meetings = trace.meetings.get(frozenset(at.bodies), ())
    return meetings[at.nth - 1] if len(meetings) >= at.nth else None


def _after_contact(trace: Trace, column: Array, at: ContactEvent) -> tuple[Array, Array] | None:
    """Return when two bodies touch and the value then; just after the impact if located."""
    meeting = _meeting(trace, at)
    if meeting is None:
        return None
    touched, time = meeting
    if time is not None and touched + 3 < len(trace.t):
        return np.array([time]), np.array([value_before(trace.t, column, time, touched)])
    after = slice(touched + 1, touched + 2)
    return (trace.t[after], column[after]) if time is None and touched + 1 < len(trace.t) else None


def _when_parted(trace: Trace, column: Array, at: SeparationEvent) -> tuple[Array, Array] | None:
    """Return when two bodies no longer touch and the value then."""
    parted = trace.partings.get(frozenset(at.bodies), ())
    if len(parted) < at.nth:
        return None
    then = slice(parted[at.nth - 1], parted[at.nth - 1] + 1)
    return trace.t[then], column[then]


def time_of(at: Expression | Passage, trace: Trace) -> float | None:
    """Return the time of an instant that may lie between two steps [s]; None if not yet reached.

    The run must have recorded the quantities that `needed_at` names for it.
    """
    if isinstance(at, Expression):
        time = at(trace.values)
        return time if time <= trace.t[-1] * (1 + ROUNDING) else None
    quantity, value, direction = crossing_of(at)
    column, level = trace.columns[quantity], value(trace.values)
    smooth, impacts = trace.smooth, trace.impacts
    return crossing(trace.t, column, level, direction, smooth=smooth, impacts=impacts)
