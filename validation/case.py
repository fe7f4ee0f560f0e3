"""What a validation case is, and how one is run."""

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from sandbox.model.catalog import find
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Instant, Level, Stepping
from sandbox.model.loading import choose, load
from sandbox.model.quantities import quantity
from sandbox.physics.checks import relative_error, samples
from sandbox.physics.errors import SimulationError
from sandbox.physics.timing import STEPS, Step, step_seconds
from sandbox.physics.trace import Trace, count_steps, needed_at, simulate
from sandbox.physics.world import build

Expected = Callable[[Values, Array], ArrayLike]
"""A closed form, of all parameters and the times that count [s]."""

Parameters = Mapping[str, float]
"""Those that differ from a level's defaults."""

Choices = tuple[Parameters, ...]

SECOND_ORDER = 1.9
"""The power of the step by which an error of second order is seen to fall, at the least."""

HALVINGS = 3
"""How often the step is halved, down to the level's own, to see by which power the error falls."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A quantity of a level, for certain parameters, and the closed form that it must meet.

    Attributes
    ----------
    name
        What is claimed, in a few words.
    level
        Such as `newton/atwood`.
    quantity
        What is measured.
    expected
        The closed form, of the parameters and the times that count [s].
    tolerance
        How large the error may be: relative, or absolute where nothing but zero is expected.
    because
        Why that much.
    parameters
        Those that differ from the level's defaults.
    at
        A time or an event; every step if None.
    duration
        How long it runs [s]; as the level says if None.
    naive_misses
        By how much naive pymunk must be off at least: proof that the case can fail. None where
        pymunk does as well by itself.
    order
        The power of the step by which the error must fall at least, as the step is halved three
        times down to the level's own; None where nothing but rounding is left.
    """

    name: str
    level: str
    quantity: str
    expected: Expected
    tolerance: float
    because: str
    parameters: Parameters = field(default_factory=dict)
    at: Instant | None = None
    duration: float | None = None
    naive_misses: float | None = None
    order: float | None = None


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a case came out; `naive` is pymunk as it comes, on the same level at the same rate.

    Attributes
    ----------
    name, level, parameters, quantity, tolerance
        As in the case, all parameters included.
    because
        Why that much is tolerated.
    unit
        Of the measured and the expected value.
    measured, expected
        The two where they are furthest apart; NaN if the event never came.
    error, naive_error
        See `relative_error`; infinite if the event never came.
    passed
        Whether the error is within its bound, the naive one beyond its own, and the order reached.
    step_seconds, naive_step_seconds
        What one step costs [s].
    order
        The power of the step by which the error falls; None if the case does not claim any.
    """

    name: str
    level: str
    parameters: Values
    quantity: str
    unit: str
    measured: float
    expected: float
    error: float
    tolerance: float
    because: str
    passed: bool
    naive_error: float
    step_seconds: float
    naive_step_seconds: float
    order: float | None


def run(cases: Iterable[Case]) -> Iterator[Outcome]:
    """Run cases one after the other; those of one level and parameters share their runs."""
    cases = list(cases)
    shared: dict[Hashable, _Runs] = {}
    for case in cases:
        runs = shared.setdefault(_key(case), _Runs(case))
        runs.record.update(dict.fromkeys(needed_at(case.quantity, case.at)))
    for case in cases:
        try:
            yield _outcome(case, shared[_key(case)])
        except SimulationError:
            yield _stopped(case, shared[_key(case)])


def _key(case: Case) -> Hashable:
    return case.level, tuple(sorted(case.parameters.items())), case.duration


class _Runs:
    """What cases of one level and parameters have in common: two runs, and two timings.

    Attributes
    ----------
    level, values
        What is run.
    record
        The quantities that the cases need, as keys.
    """

    def __init__(self, case: Case) -> None:
        self.level = load(find(case.level))
        self.values = choose(self.level, case.parameters)
        self.record: dict[str, None] = {}
        self._duration = case.duration

    @cached_property
    def ours(self) -> Trace:
        return self._simulate(self.level.stepping)

    @cached_property
    def theirs(self) -> Trace:
        return self._simulate(naive(self.level))

    @cached_property
    def seconds(self) -> tuple[float, float]:
        """What a step of each costs [s]; they are timed in turn."""
        steppings = self.level.stepping, naive(self.level)
        steps = min(count_steps(build(self.level, self.values)), STEPS)
        ours, theirs = step_seconds([self._start(s) for s in steppings], max(steps, 1))
        return ours, theirs

    def _start(self, stepping: Stepping) -> Callable[[], Step]:
        return lambda: build(self.level, self.values, stepping).step

    @cached_property
    def coarser(self) -> tuple[Trace, ...]:
        """The same run with twice the step, four times the step, and so on."""
        stepping = self.level.stepping
        rates = [stepping.rate / 2**i for i in range(1, HALVINGS + 1)]
        return tuple(self._simulate(stepping.model_copy(update={"rate": rate})) for rate in rates)

    def _simulate(self, stepping: Stepping) -> Trace:
        return simulate(self.level, self.values, self._duration, self.record, stepping)


def naive(level: Level) -> Stepping:
    """Return how time advances when pymunk is used as it comes, at the level's own rate."""
    return Stepping(rate=level.stepping.rate, scheme="symplectic-euler")


def _outcome(case: Case, runs: _Runs) -> Outcome:
    measured, expected, error = _compare(case, runs.ours)
    _, _, naive_error = _compare(case, runs.theirs)
    proven = case.naive_misses is None or naive_error > case.naive_misses
    order = None if case.order is None else _order(case, runs, error)
    converges = order is None or case.order is None or order >= case.order
    return Outcome(
        name=case.name,
        level=case.level,
        parameters=runs.values,
        quantity=case.quantity,
        unit=quantity(case.quantity, runs.level).unit,
        measured=measured,
        expected=expected,
        error=error,
        tolerance=case.tolerance,
        because=case.because,
        passed=error <= case.tolerance and proven and converges,
        naive_error=naive_error,
        step_seconds=runs.seconds[0],
        naive_step_seconds=runs.seconds[1],
        order=order,
    )


def _stopped(case: Case, runs: _Runs) -> Outcome:
    """Return how a case comes out whose run had to stop."""
    nan = float("nan")
    return Outcome(
        name=case.name,
        level=case.level,
        parameters=runs.values,
        quantity=case.quantity,
        unit=quantity(case.quantity, runs.level).unit,
        measured=nan,
        expected=nan,
        error=float("inf"),
        tolerance=case.tolerance,
        because=case.because,
        passed=False,
        naive_error=nan,
        step_seconds=nan,
        naive_step_seconds=nan,
        order=None,
    )


def _order(case: Case, runs: _Runs, error: float) -> float:
    """Return the slope of the error over the step, both logarithmic; NaN if there is none."""
    errors = np.array([error, *(_compare(case, trace)[2] for trace in runs.coarser)])
    if not (np.isfinite(errors) & (errors > 0)).all():
        return float("nan")
    return float(np.polyfit(np.arange(len(errors)), np.log2(errors), 1)[0])


def _compare(case: Case, trace: Trace) -> tuple[float, float, float]:
    """Return measured, expected and the error."""
    found = samples(trace, case.quantity, case.at)
    if found is None:
        return float("nan"), float("nan"), float("inf")
    t, measured = found
    expected = np.broadcast_to(np.asarray(case.expected(trace.values, t), dtype=float), t.shape)
    error, worst = relative_error(measured, expected)
    return float(measured[worst]), float(expected[worst]), error
