"""The checks of a run that is still going on."""

from dataclasses import dataclass
from time import perf_counter

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
        At the last recorded step, or at the check's event; None if there are none yet.
    """

    result: Result
    measured: float | None
    expected: float | None


class Grading:
    """Grades what a recorder has noted, no more often than the time for it allows."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._readings: tuple[Reading, ...] = ()
        self._graded = 0
        self._next = 0.0

    def readings(self, hurried: bool) -> tuple[Reading, ...]:
        """Return how the checks stand; if there is a hurry, perhaps how they stood just before."""
        now = perf_counter()
        if self._graded != len(self._recorder) and (now >= self._next or not hurried):
            self._graded = len(self._recorder)
            trace = self._recorder.trace
            self._readings = tuple(_reading(result, trace) for result in grade(trace))
            self._next = now + max(LEAST, (perf_counter() - now) / SHARE)
        return self._readings


def _reading(result: Result, trace: Trace) -> Reading:
    check = result.check
    if check.at is not None or result.measured is None:
        return Reading(result, result.measured, result.expected)
    expected = check.formula.over(trace.values, trace.t[-1:])
    return Reading(result, float(trace.columns[check.quantity][-1]), float(expected[0]))
