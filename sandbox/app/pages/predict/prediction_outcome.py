"""The judgement of a prediction, by the formula and by the run."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from sandbox.app.words.language import say, say_in
from sandbox.model.level import Check
from sandbox.physics.measuring.grading import ZERO, Result, grade_check, least_scale
from sandbox.physics.measuring.recording import Trace

LIMITS: Sequence[float] = (0.01, 0.05, 0.2)
"""The grades of a prediction: within 1 %, 5 % or 20 %."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a prediction."""

    predicted: float
    """The predicted value."""
    formula: float | None
    """The value of the formula; None after a change by hand, which no formula describes."""
    simulated: float
    """The simulated value."""
    unit: str
    """The unit of the quantity."""
    scale: float | None
    """The reference of relative differences; None if they are absolute, since all values are zero.
    """
    t: float | None = None
    """The time of the measurement [s]."""

    def difference(self, value: float) -> float:
        """Return the difference of a value from the simulated one, relative if possible."""
        return (value - self.simulated) / (self.scale or 1.0)

    @property
    def limit(self) -> float | None:
        """The smallest of `LIMITS` within which the prediction is; None if there is none."""
        off = abs(self.difference(self.predicted))
        return next((limit for limit in LIMITS if off <= limit * (1 + 1e-9)), None)

    @property
    def verdict(self) -> str:
        """A short verdict on the prediction."""
        if self.limit is None:
            return say_in("a prediction", "off")
        return say("within {share:g} %", share=100 * self.limit)


def judged(
    check: Check, trace: Trace, predicted: float, *, formula_holds: bool = True
) -> Outcome | None:
    """Compare a prediction with a run; None before the run reaches the instant."""
    result = grade_check(check, trace)
    if result.measured is None:
        return None
    formula = result.expected if formula_holds else None
    scale = _scale(result, formula, trace)
    return Outcome(predicted, formula, result.measured, result.unit, scale, result.t)


def _scale(result: Result, formula: float | None, trace: Trace) -> float | None:
    """Return the absolute value of the formula, or else of the measured value.

    If that is zero, it is the largest absolute value in the run; None if even that is rounding.
    """
    check, measured = result.check, result.measured
    assert measured is not None
    size = abs(formula if formula is not None and isfinite(formula) else measured)
    size = max(size, least_scale(check, trace.values))
    if size > ZERO:
        return size
    column = np.abs(trace.columns[check.quantity])
    largest = float(column[np.isfinite(column)].max(initial=0.0))
    return largest if largest > check.tolerance else None  # else it is rounding
