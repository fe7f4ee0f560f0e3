"""The checks of a run that is still going on."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from sandbox.app.milestones import Milestone, milestones
from sandbox.model.expressions import Expression, ExpressionError, Values
from sandbox.model.level import Check
from sandbox.physics.checks import Result, grade
from sandbox.physics.trace import Recorder, Trace

SHARE = 0.05
"""The share of the time that grading may take while time runs."""

LEAST = 0.1  # s, between two gradings


@dataclass(frozen=True, slots=True)
class Reading:
    """A check's result so far; for one that holds at every step, with the values of now.

    Attributes
    ----------
    measured, expected
        At the check's event, else, also while that is waited for, at the last recorded step; what
        is expected of an event may be unknown before it. None if there are none yet.
    """

    result: Result
    measured: float | None
    expected: float | None


class Grading:
    """Grades what a recorder has noted, no more often than the time for it allows."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._readings: tuple[Reading, ...] = ()
        self._milestones: tuple[Milestone, ...] = ()
        self._graded = 0
        self._next = 0.0

    def readings(self, hurried: bool) -> tuple[Reading, ...]:
        """Return how the checks stand; if there is a hurry, perhaps how they stood just before."""
        now = perf_counter()
        if self._graded != len(self._recorder) and (now >= self._next or not hurried):
            self._graded = len(self._recorder)
            trace = self._recorder.trace
            results = grade(trace)
            self._readings = tuple(_reading(result, trace) for result in results)
            self._milestones = milestones(results, trace)
            self._next = now + max(LEAST, (perf_counter() - now) / SHARE)
        return self._readings

    @property
    def milestones(self) -> tuple[Milestone, ...]:
        """What had happened when the readings were last taken."""
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
    """Return what is expected of an instant to come, None if that depends on when it comes."""
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
