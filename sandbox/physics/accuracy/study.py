"""A study of a level's accuracy: how large the error is, what causes it, what less would cost.

A study is a row of findings, each told as soon as it is known, for somebody who looks on.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import islice
from math import isfinite
from typing import Literal

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.message import Message
from sandbox.model.quantities import momentary
from sandbox.physics.accuracy.calibration import Setting, calibrate
from sandbox.physics.accuracy.cheapest_setting import with_scales
from sandbox.physics.accuracy.compared_runs import (
    Watched,
    by_check,
    never,
    record,
    scaled,
    watched,
)
from sandbox.physics.accuracy.refinement import (
    Refinement,
    foot,
    held_against,
    judged,
    step_durations,
)
from sandbox.physics.accuracy.refinement_search import Refiner, refine
from sandbox.physics.accuracy.richardson import extrapolated
from sandbox.physics.accuracy.trusted_digits import Trust, trusts
from sandbox.physics.measuring.grading import Result, grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.scene.schemes import usable
from sandbox.physics.stepping.make_world import make_world

REFINING = 2.0
"""s, for the runs of one scheme; a run in progress is not cut short."""

SEARCH = 4.0
"""s, for the runs that look for a cheaper setting."""

FINEST = 1e-10
"""No scheme is refined beyond this error: the rest is rounding."""

EXACT = 1e-10
"""A formula that is off by less at a small step is exact, and no approximation."""


MANY = 200
"""For how many quantities the trusted digits are determined, at most."""


Stage = Literal[
    "starting", "looking for the cheapest setting", "halving the step", "{scheme} at many rates"
]


@dataclass(frozen=True, slots=True)
class Progress:
    """Which share is done, and what comes next, with `{scheme}` for the scheme that is tried."""

    share: float
    stage: Stage
    scheme: str = ""


@dataclass(frozen=True, slots=True)
class Point:
    """A setting, its largest numerical error, and what a second of the scene costs [s]."""

    scheme: Scheme
    rate: float
    error: float
    cost: float


@dataclass(frozen=True, slots=True)
class Here(Point):
    """The setting of the present run."""


@dataclass(frozen=True, slots=True)
class Split:
    """What the error of a check is made of; relative as a check's error is.

    Attributes
    ----------
    check
        The index of the check in the level.
    off
        By how much the measured number may be off for the step [its unit].
    total
        The check's error; None where its formula does not hold, or its instant never comes.
    model
        What stays of it as the step goes to zero: the formula's own approximation. 0 if none is
        seen, None where the formula does not hold.
    numerical
        What halving the step says of it.
    remaining
        What neither explains, such as rounding.
    """

    check: int
    off: float
    total: float | None
    model: float | None
    numerical: float
    remaining: float | None


@dataclass(frozen=True, slots=True)
class Failed:
    """Why there is no more to be found."""

    reason: Message


Finding = Progress | Point | Here | Split | Trust | Setting | Failed


def study(level: Level, values: Values) -> Iterator[Finding]:
    """Yield what other settings err and cost, then what the error of the run is made of."""
    try:
        yield from _others(level, values)
        yield from _own(level, values)
    except SandboxError as error:
        yield Failed(error.message)


def split(level: Level, values: Values) -> Iterator[Finding]:
    """Yield what the error of the run is made of."""
    try:
        yield from _own(level, values)
    except SandboxError as error:
        yield Failed(error.message)


def seek(level: Level, values: Values, target: float, seconds: float = SEARCH) -> Iterator[Finding]:
    """Yield the cheapest setting that reaches an accuracy, looked for that long [s]."""
    try:
        yield Progress(0.1, "looking for the cheapest setting")
        yield calibrate(level, values, target, seconds)
    except SandboxError as error:
        yield Failed(error.message)


def trusted(level: Level, values: Values, names: Iterable[str]) -> tuple[Trust, ...]:
    """Return how far quantities of a level's own run can be trusted.

    Raises
    ------
    SimulationError
        If it does not run, or not with half of its step.
    """
    items = [Watched(name) for name in names]
    return tuple(trusts(list(_halved(level, values, items)), items))


def _own(level: Level, values: Values) -> Iterator[Finding]:
    """Run at half the level's own rate, at that, and at twice that.

    The error of the run is that of its checks and of all motion: a check may hold at instants at
    which nothing moves.
    """
    yield Progress(0.9, "halving the step")
    items = [by_check(check, values) for check in level.checks]
    judging = watched(level, values)
    drawn = [Watched(found.name) for found in islice(momentary(level), MANY)]
    own = level.stepping
    traces = list(_halved(level, values, [*items, *judging, *drawn]))
    yield from trusts(traces, drawn)
    results = zip(grade(traces[-2]), grade(traces[-1]), strict=True)
    for index, (item, result) in enumerate(zip(items, results, strict=True)):
        if found := extrapolated(traces, item):
            *_, numerical, rest = found.relative
            yield _split(index, result, found.of[-2], numerical, rest)
    [step] = brief_costs(partial(make_world, level, values, own))
    yield Here(own.scheme, own.rate, _error(traces, judging), step * own.rate)


def _error(traces: Sequence[Trace], wanted: Sequence[Watched]) -> float:
    """Return the largest relative error of the run before the last; 0 if nothing moves."""
    moving = scaled(wanted, traces[-2])
    return judged(traces, moving).errors[-2] if moving else 0.0


def _halved(level: Level, values: Values, items: Sequence[Watched]) -> Iterator[Trace]:
    """Yield a run with twice the step, if that can be, with the level's own, and with half of it.

    The first only shows by which power of the step the error falls.
    """
    rate = level.stepping.rate
    with suppress(SandboxError):
        twice = level.stepping.model_copy(update={"rate": rate / 2})
        yield record(level, values, twice, items)
    yield record(level, values, level.stepping, items)
    yield record(level, values, level.stepping.model_copy(update={"rate": 2 * rate}), items)


def _split(
    index: int, results: tuple[Result, Result], off: float, numerical: float, rest: float
) -> Split:
    """Split a check's error, from how it came out at the step and at half of it."""
    coarse, fine = results
    if coarse.error is None or fine.error is None:
        return Split(index, off, None, None, numerical, None)
    model = fine.error if fine.error > 2 * rest + EXACT else 0.0
    remaining = max(coarse.error - numerical - model, 0.0)
    return Split(index, off, coarse.error, model, numerical, remaining)


def _others(level: Level, values: Values) -> Iterator[Finding]:
    """Refine the step of each scheme, and hold all against the best."""
    starts = list(_starts(level))
    wanted = with_scales(level, values, watched(level, values))
    refinements: list[Refinement] = []
    for index, start in enumerate(starts):
        yield Progress((1 + index) / (2 + len(starts)), "{scheme} at many rates", start.scheme)
        refiner = Refiner(level, values, start, wanted, FINEST)
        refine([refiner], REFINING, never)
        refinements += [refiner.refinement] if refiner.refinement else []
    if not refinements:
        return
    best = min(refinements, key=_doubt)
    steps = step_durations(
        level, values, *(refinement.traces[-1].stepping for refinement in refinements)
    )
    for refinement, step in zip(refinements, steps, strict=True):
        shown = refinement if refinement is best else held_against(refinement, best, wanted)
        yield from _points(shown, step)


def _doubt(refinement: Refinement) -> tuple[bool, float]:
    """Return what makes a refinement a worse judge: pymunk's impacts agree by chance."""
    last = refinement.traces[-1]
    naive = last.stepping.is_stock and last.level.effects.contact is not None
    return naive, refinement.errors[-1]


def _points(refinement: Refinement, step: float) -> Iterator[Point]:
    trace: Trace
    for trace, error in zip(refinement.traces, refinement.errors, strict=True):
        rate = trace.stepping.rate
        if isfinite(error):
            yield Point(trace.stepping.scheme, rate, error, step * rate)


def _starts(level: Level) -> Iterator[Stepping]:
    """Yield every scheme that the level can use, at a low rate."""
    for scheme in usable(level):
        update = {"scheme": scheme, "rate": foot(level.stepping.rate)}
        yield level.stepping.model_copy(update=update)
