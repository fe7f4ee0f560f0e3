"""The goals of a challenge, and the judging of runs by them."""

from dataclasses import dataclass
from math import inf, nan
from typing import Literal

import numpy as np

from sandbox.model.challenge import Goal
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.physics.measuring.grading import samples
from sandbox.physics.measuring.recording import Trace

Standing = Literal["met", "missed", "open"]


@dataclass(frozen=True, slots=True)
class Outcome:
    """The state of a goal."""

    goal: Goal
    unit: str
    """The unit of the quantity."""
    t: float | None
    measured: float | None
    """The time at which the quantity was furthest beyond its bounds or closest to them, or the time
    of the event [s], and the value then; None if the event has not come."""
    lower: float
    upper: float
    """The bounds with the run's parameters; infinite if there is none."""
    standing: Standing
    """`open` while the run can still decide it."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """The state of a challenge after a run, or during one."""

    outcomes: tuple[Outcome, ...]
    """The states of all goals: those for the first star, then one for each further star."""
    stars: int
    """The number of stars earned so far."""
    possible_stars: int
    """The number of stars that there are."""
    complete: bool
    """Whether the run has lasted for the duration of its level."""
    changed_parameters: tuple[str, ...]
    """The locked parameters that differ from the level's values; if any, no star counts."""

    @property
    def solved(self) -> bool:
        """Whether a star is earned."""
        return self.stars > 0


def attempt(trace: Trace) -> Attempt | None:
    """Judge a run by its level's challenge; None if it has none.

    Stars count only once the run is complete: until then a goal that has to hold at every step is
    open. The run must have recorded what `needed` names.
    """
    challenge = trace.level.challenge
    if challenge is None:
        return None
    complete = trace.complete
    outcomes = tuple(_outcome(goal, trace, complete=complete) for goal in challenge.all_goals)
    first = len(challenge.goals)
    solved = all(outcome.standing == "met" for outcome in outcomes[:first])
    further = sum(outcome.standing == "met" for outcome in outcomes[first:])
    changed_parameters = tuple(
        name
        for name, value in trace.level.defaults.items()
        if name not in challenge.free and trace.values[name] != value
    )
    stars = 1 + further if solved and not changed_parameters else 0
    return Attempt(outcomes, stars, 1 + len(challenge.stars), complete, changed_parameters)


def _outcome(goal: Goal, trace: Trace, *, complete: bool) -> Outcome:
    unit = trace.units[goal.quantity]
    lower, upper = bounds(goal, trace.values)
    found = samples(trace, goal.quantity, goal.at)
    if found is None:
        standing: Standing = "missed" if complete else "open"
        return Outcome(goal, unit, None, None, lower, upper, standing)
    t, measured = found
    slack = np.minimum(measured - lower, upper - measured)
    worst = int(np.argmin(np.where(np.isnan(slack), -inf, slack)))
    met = bool(slack[worst] >= 0)
    decided = complete or goal.at is not None or not met
    standing = ("met" if met else "missed") if decided else "open"
    return Outcome(goal, unit, float(t[worst]), float(measured[worst]), lower, upper, standing)


def bounds(goal: Goal, values: Values) -> tuple[float, float]:
    """Return the lower and upper bound of a goal; not a number where one has no value."""
    return _bound(goal.above, values, -inf), _bound(goal.below, values, inf)


def _bound(bound: Expression | None, values: Values, default: float) -> float:
    """Return the value of a bound; not a number if it has none with these parameters."""
    try:
        return default if bound is None else bound(values)
    except ExpressionError:
        return nan
