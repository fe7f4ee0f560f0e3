"""A validation case, and running it."""

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from math import inf, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from sandbox.model.events import tied_joints
from sandbox.model.expressions import Array, Values
from sandbox.model.joints import Own, is_exact
from sandbox.model.level import Instant, Level, Stepping
from sandbox.model.level_catalog import find
from sandbox.model.level_parts import names_in
from sandbox.model.loading import choose, load
from sandbox.model.quantities import quantity
from sandbox.physics.measuring.grading import relative_error, samples
from sandbox.physics.measuring.recording import Trace, needed_at
from sandbox.physics.measuring.step_timing import step_costs
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError

Expected = Callable[[Values, Array], ArrayLike]
"""A closed form, as a function of all parameters and of the sampled times [s]."""

Parameters = Mapping[str, float]
"""The parameters that differ from a level's defaults."""

Choices = tuple[Parameters, ...]

SECOND_ORDER = 1.9
"""The least power of the step with which an error of second order must fall."""

FOURTH_ORDER = 3.8
"""The same for an error of fourth order."""

HALVINGS = 3
"""How often the step is halved, down to the level's own, to measure the order."""


@cache
def textbook(name: str) -> Level:
    """Return a level of the catalog, which never changes."""
    return load(find(name))


def ends(level: str, *turned: str) -> Choices:
    """Return two opposite corners of a level's ranges, which include all ends of all ranges.

    At the first corner the parameters named in `turned` have their maximum, and all others their
    minimum.
    """
    ranges = textbook(level).parameters.items()
    low = {name: range_.max if name in turned else range_.min for name, range_ in ranges}
    high = {name: range_.min if name in turned else range_.max for name, range_ in ranges}
    return low, high


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A quantity of a level with certain parameters, and the closed form that it must match."""

    name: str
    """The claim, in a few words."""
    level: str
    """The name of the level, such as `newton/atwood`."""
    quantity: str
    """The measured quantity."""
    expected: Expected
    """The closed form, of the parameters and the sampled times [s]."""
    tolerance: float
    """The largest allowed error: relative, or absolute if only zero is expected."""
    because: str
    """The reason for that tolerance."""
    parameters: Parameters = field(default_factory=dict)
    """The parameters that differ from the level's defaults."""
    at: Instant | None = None
    """A time or an event; None for every step."""
    duration: float | None = None
    """The length of the run [s]; None for the level's own."""
    naive_misses: float | None = None
    """The least error of naive pymunk, which proves that the case can fail. None if pymunk does as
    well by itself."""
    order: float | None = None
    """The least power of the step with which the error must fall, as the step is halved three times
    down to the level's own; None if only rounding remains."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a case; `naive` is stock pymunk, on the same level at the same rate."""

    name: str
    level: str
    parameters: Values
    quantity: str
    """As in the case, with all parameters."""
    unit: str
    """The unit of the measured and the expected value."""
    measured: float
    expected: float
    """The two values where they differ most; NaN if the event never occurred."""
    error: float
    """See `relative_error`; infinite if the event never occurred."""
    tolerance: float
    because: str
    """As in the case."""
    passed: bool
    """Whether the error is within its bound, the naive error beyond its own, and the order reached.
    """
    naive_error: float
    """The same of stock pymunk."""
    step_seconds: float
    naive_step_seconds: float
    """The time of a step of the level with its defaults [s]."""
    order: float | None
    """The power of the step with which the error falls; None if the case claims no order."""


def run(cases: Sequence[Case]) -> Iterator[Outcome]:
    """Run cases one after the other; those of one level and parameters share their runs."""
    shared: dict[int, _Runs] = {}
    for rows in together(cases):
        shared.update(dict.fromkeys(rows, _Runs([cases[row] for row in rows])))
    for row, case in enumerate(cases):
        yield _outcome(case, shared[row])


def together(cases: Sequence[Case]) -> list[list[int]]:
    """Return the groups of cases that share their runs, by their indices."""
    groups: dict[Hashable, list[int]] = {}
    for row, case in enumerate(cases):
        key = case.level, tuple(sorted(case.parameters.items())), case.duration
        groups.setdefault(key, []).append(row)
    return list(groups.values())


class _Runs:
    """The runs that cases of one level and parameters share."""

    def __init__(self, cases: Sequence[Case]) -> None:
        first = cases[0]
        self.level = textbook(first.level)
        self.values = choose(self.level, first.parameters)
        self._duration = first.duration
        needed = (name for case in cases for name in needed_at(case.quantity, case.at))
        self._record = tuple(dict.fromkeys(needed))

    @cached_property
    def ours(self) -> Trace:
        return self._simulate(self.level.stepping)

    @cached_property
    def theirs(self) -> Trace:
        return simulate(naive(self.level), self.values, self._duration, self._record)

    @cached_property
    def coarser(self) -> tuple[Trace, ...]:
        """The same run with twice the step, four times the step, and so on."""
        stepping = self.level.stepping
        rates = [stepping.rate / 2**i for i in range(1, HALVINGS + 1)]
        return tuple(self._simulate(stepping.model_copy(update={"rate": rate})) for rate in rates)

    def _simulate(self, stepping: Stepping) -> Trace:
        return simulate(self.level, self.values, self._duration, self._record, stepping)


def naive(level: Level) -> Level:
    """Return a level with stock pymunk: its scheme at the level's own rate, and its joints.

    Joints that pymunk lacks (strings over pegs, wires, rails, lengths that change with time, joints
    that events tie) stay exact, and with them the other joints of that level: one body cannot be
    held in both ways.
    """
    stepping = Stepping(rate=level.stepping.rate, scheme="symplectic-euler")
    exact = [joint for joint in level.joints.values() if is_exact(joint)]
    own = all(isinstance(joint, Own) and "t" not in names_in(joint) for joint in exact)
    joints = level.joints
    if own and not (level.effects.sticking or tied_joints(level.events)):
        joints = {
            name: joint.model_copy(update={"exact": False}) if isinstance(joint, Own) else joint
            for name, joint in joints.items()
        }
    return level.model_copy(update={"stepping": stepping, "joints": joints})


@cache
def _seconds(name: str) -> tuple[float, float]:
    """Return the time of a step of a level and of stock pymunk [s], measured in turn.

    The level has its default parameters, which hardly matter.
    """
    level = textbook(name)
    ours, theirs = step_costs(*(partial(build, each) for each in (level, naive(level))))
    return ours, theirs


class _Found(NamedTuple):
    """The results of a case; the defaults are those of a run that had to stop."""

    measured: float = nan
    expected: float = nan
    error: float = inf
    passed: bool = False
    naive_error: float = nan
    step_seconds: float = nan
    naive_step_seconds: float = nan
    order: float | None = None


def _outcome(case: Case, runs: _Runs) -> Outcome:
    try:
        found = _judged(case, runs)
    except SimulationError:
        found = _Found()
    return Outcome(
        name=case.name,
        level=case.level,
        parameters=runs.values,
        quantity=case.quantity,
        unit=quantity(case.quantity, runs.level).unit,
        tolerance=case.tolerance,
        because=case.because,
        **found._asdict(),
    )


def _judged(case: Case, runs: _Runs) -> _Found:
    measured, expected, error = _compare(case, runs.ours)
    _, _, naive_error = _compare(case, runs.theirs)
    proven = case.naive_misses is None or naive_error > case.naive_misses
    order = None if case.order is None else _order(case, runs, error)
    converges = order is None or case.order is None or order >= case.order
    passed = error <= case.tolerance and proven and converges
    return _Found(measured, expected, error, passed, naive_error, *_seconds(case.level), order)


def _order(case: Case, runs: _Runs, error: float) -> float:
    """Return the slope of log error over log step; NaN if it has none."""
    errors = np.array([error, *(_compare(case, trace)[2] for trace in runs.coarser)])
    if not (np.isfinite(errors) & (errors > 0)).all():
        return nan
    return float(np.polyfit(np.arange(len(errors)), np.log2(errors), 1)[0])


def _compare(case: Case, trace: Trace) -> tuple[float, float, float]:
    """Return the measured and the expected value, and the error."""
    found = samples(trace, case.quantity, case.at)
    if found is None:
        return nan, nan, inf
    t, measured = found
    expected = np.broadcast_to(np.asarray(case.expected(trace.values, t), dtype=float), t.shape)
    error, worst = relative_error(measured, expected)
    return float(measured[worst]), float(expected[worst]), error
