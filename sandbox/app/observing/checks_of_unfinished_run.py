"""The checks of a run that is still in progress."""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Generic, TypeVar

import numpy as np

from sandbox.app.observing.events_of_checks import Milestone, milestones
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import Check
from sandbox.physics.measuring.grading import Result, grade
from sandbox.physics.measuring.recording import Recorder, Trace

T = TypeVar("T")

SHARE = 0.05
"""The fraction of the time that grading may take while the run plays."""

LEAST = 0.1  # s, the least time between two evaluations


@dataclass(frozen=True, slots=True)
class Reading:
    """A check's result so far, with its values."""

    result: Result
    """The result so far."""
    measured: float | None
    """The value at the check's event; before it, and for a check at every step, the value at the
    last recorded step. None if there is none yet."""
    expected: float | None
    """The value expected then, or before the event, at the event; None if that is unknown."""


class TimeShare(Generic[T]):
    """Evaluates a growing run, within the share of time that this may take."""

    def __init__(self, look: Callable[[], T], nothing: T) -> None:
        self._look = look
        self.found = nothing
        """The last result."""
        self._seen = 0
        self._next = 0.0

    def __call__(self, length: int, *, hurried: bool) -> T:
        """Return the result for a run of some length; if `hurried`, perhaps a slightly old one."""
        now = perf_counter()
        if self._seen != length and (now >= self._next or not hurried):
            self._seen = length
            self.found = self._look()
            self._next = now + max(LEAST, (perf_counter() - now) / SHARE)
        return self.found


class RunGrader:
    """Grades a recorded run, within the share of time that this may take."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._milestones: tuple[Milestone, ...] | None = ()  # None: to be determined on request
        self._time_share: TimeShare[tuple[Reading, ...]] = TimeShare(self._grade, ())

    def readings(self, hurried: bool) -> tuple[Reading, ...]:
        """Return the results of the checks; if `hurried`, perhaps slightly old ones."""
        return self._time_share(len(self._recorder), hurried=hurried)

    def _grade(self) -> tuple[Reading, ...]:
        trace = self._recorder.trace
        results = grade(trace)
        self._milestones = None
        return tuple(_reading(result, trace) for result in results)

    @property
    def milestones(self) -> tuple[Milestone, ...]:
        """The events up to the last readings; the positions of their bodies must be recorded."""
        if self._milestones is None:
            results = (reading.result for reading in self._time_share.found)
            self._milestones = milestones(results, self._recorder.trace)
        return self._milestones


def _reading(result: Result, trace: Trace) -> Reading:
    check = result.check
    now = float(trace.columns[check.quantity][-1])
    if check.at is not None and result.verdict == "waiting":
        return Reading(result, now, _ahead(check, trace.values))
    if check.at is not None or result.measured is None:
        return Reading(result, result.measured, result.expected)
    expected = check.formula.over(trace.values, trace.t[-1:])
    return Reading(result, now, float(expected[0]))


def _ahead(check: Check, values: Values) -> float | None:
    """Return the value expected at an event to come; None if it depends on an unknown time."""
    if "t" not in check.formula.names:
        time = 0.0
    elif isinstance(check.at, Expression):
        time = check.at(values)
    else:
        return None
    try:
        return float(check.formula.over(values, np.array(time)))
    except ExpressionError:
        return None
