"""A study of a level's accuracy: the size of the error, its causes, and the cost of a smaller one.

A study yields findings as soon as they are known, so that they can be shown live.
"""

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import islice
from math import isfinite
from queue import SimpleQueue
from typing import Literal

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.quantities import momentary_quantities
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.accuracy.compared_runs import (
    Watched,
    check_item,
    never,
    record,
    scaled,
    watched,
)
from sandbox.physics.accuracy.refinement_scheduling import Refiner, refine
from sandbox.physics.accuracy.requested_accuracy import Setting, calibrate
from sandbox.physics.accuracy.richardson_extrapolation import extrapolated
from sandbox.physics.accuracy.setting_search import own_run
from sandbox.physics.accuracy.step_refinement import (
    Refinement,
    lowest_doubled_rate,
    relative_to,
    step_durations,
    with_errors,
)
from sandbox.physics.accuracy.trusted_digits import Trust, trust_of
from sandbox.physics.measuring.grading import Result, grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.scene.usable_schemes import usable
from sandbox.physics.stepping.make_world import make_world

REFINING = 2.0
"""The counted work of the runs of one scheme [s]; a run in progress is not interrupted."""

SEARCH = 4.0
"""The counted work of the search for a cheaper setting [s]."""

FINEST = 1e-10
"""The smallest error to which a scheme is refined; below it is rounding."""

EXACT = 1e-10
"""The error at a small step below which a formula counts as exact."""


MANY = 200
"""The most quantities whose trusted digits are determined."""


Stage = Literal[
    "starting", "looking for the cheapest setting", "halving the step", "{scheme} at many rates"
]


@dataclass(frozen=True, slots=True)
class Progress:
    """The share that is done, and the next step, with `{scheme}` for the scheme that is tried."""

    fraction: float
    stage: Stage
    scheme: str = ""
    detail: Message = NOTHING
    """The stage in more detail, if there is any: the run that is about to be taken."""


@dataclass(frozen=True, slots=True)
class WorkPrecisionPoint:
    """A setting, its largest numerical error, and its cost per second of the scene [s]."""

    scheme: Scheme
    rate: float
    error: float
    cost: float


@dataclass(frozen=True, slots=True)
class CurrentSetting(WorkPrecisionPoint):
    """The setting of the present run."""


@dataclass(frozen=True, slots=True)
class ErrorBudget:
    """The parts of a check's error, relative as a check's error is."""

    check: int
    """The index of the check in the level."""
    difference: float
    """The numerical error of the measured value [its unit]."""
    total: float | None
    """The check's error; None where its formula does not apply, or its instant never occurs."""
    model: float | None
    """The error that remains as the step goes to zero: the approximation in the formula. 0 if there
    is none, None where the formula does not apply."""
    numerical: float
    """The error due to the step, from halving it."""
    remaining: float | None
    """The rest, such as rounding."""


@dataclass(frozen=True, slots=True)
class Failed:
    """The reason why the study cannot continue."""

    reason: Message


Finding = Progress | WorkPrecisionPoint | CurrentSetting | ErrorBudget | Trust | Setting | Failed


def study(level: Level, values: Values) -> Iterator[Finding]:
    """Yield the errors and costs of other settings, then the parts of the run's error."""
    try:
        yield from _other_schemes(level, values)
        yield from _own_error(level, values)
    except SandboxError as error:
        yield Failed(error.message)


def split(level: Level, values: Values) -> Iterator[Finding]:
    """Yield the parts of the run's error."""
    try:
        yield from _own_error(level, values)
    except SandboxError as error:
        yield Failed(error.message)


def seek(level: Level, values: Values, target: float, seconds: float = SEARCH) -> Iterator[Finding]:
    """Yield the cheapest setting that reaches an accuracy, within a work of about [s]."""
    stage: Stage = "looking for the cheapest setting"
    reports: SimpleQueue[Progress | None] = SimpleQueue()

    def report(fraction: float, detail: Message) -> None:
        reports.put(Progress(fraction, stage, detail=detail))

    yield Progress(0.0, stage)
    with ThreadPoolExecutor(1) as thread:
        future = thread.submit(calibrate, level, values, target, seconds, report)
        future.add_done_callback(lambda _: reports.put(None))
        yield from iter(reports.get, None)
    try:
        yield future.result()
    except SandboxError as error:
        yield Failed(error.message)


def trusted(level: Level, values: Values, names: Iterable[str]) -> tuple[Trust, ...]:
    """Return how far quantities of a level's own run can be trusted.

    Raises `SimulationError` if it does not run at its own step, or at half of that.
    """
    items = [Watched(name) for name in names]
    return tuple(trust_of(list(_runs_to_compare(level, values, items)), items))


def _own_error(level: Level, values: Values) -> Iterator[Finding]:
    """Run at half the level's own rate, at that rate, and at twice that.

    The error of the run is that of its checks and of all motion, since a check may hold only at
    instants at which nothing moves.
    """
    yield Progress(0.9, "halving the step")
    items = [check_item(check, values) for check in level.checks]
    judging = watched(level, values)
    drawn = [Watched(found.name) for found in islice(momentary_quantities(level), MANY)]
    own = level.stepping
    traces = list(_runs_to_compare(level, values, [*items, *judging, *drawn]))
    yield from trust_of(traces, drawn)
    results = zip(grade(traces[-2]), grade(traces[-1]), strict=True)
    for index, (item, result) in enumerate(zip(items, results, strict=True)):
        if found := extrapolated(traces, item):
            *_, numerical, rest = found.relative
            yield _budget(index, result, found.absolute[-2], numerical, rest)
    [step] = brief_costs(partial(make_world, level, values, own))
    yield CurrentSetting(own.scheme, own.rate, _error(traces, judging), step * own.rate)


def _error(traces: Sequence[Trace], watched_items: Sequence[Watched]) -> float:
    """Return the largest relative error of the run before the last; 0 if nothing moves."""
    moving = scaled(watched_items, traces[-2])
    return with_errors(traces, moving).errors[-2] if moving else 0.0


def _runs_to_compare(level: Level, values: Values, items: Sequence[Watched]) -> Iterator[Trace]:
    """Yield a run with twice the step, if possible, one with the level's own, and one with half.

    The first only serves to find the order with which the error falls.
    """
    rate = level.stepping.rate
    with suppress(SandboxError):
        twice = level.stepping.model_copy(update={"rate": rate / 2})
        yield record(level, values, twice, items)
    yield record(level, values, level.stepping, items)
    yield record(level, values, level.stepping.model_copy(update={"rate": 2 * rate}), items)


def _budget(
    index: int, results: tuple[Result, Result], off: float, numerical: float, rest: float
) -> ErrorBudget:
    """Split a check's error, given its results at the step and at half of it."""
    coarse, fine = results
    if coarse.error is None or fine.error is None:
        return ErrorBudget(index, off, None, None, numerical, None)
    model = fine.error if fine.error > 2 * rest + EXACT else 0.0
    remaining = max(coarse.error - numerical - model, 0.0)
    return ErrorBudget(index, off, coarse.error, model, numerical, remaining)


def _other_schemes(level: Level, values: Values) -> Iterator[Finding]:
    """Refine the step of each scheme, and compare all with the best."""
    starts = list(_first_steppings(level))
    watched_items: Sequence[Watched] = watched(level, values)
    if own := own_run(level, values, watched_items):
        watched_items = scaled(watched_items, own)
    refinements: list[Refinement] = []
    for index, start in enumerate(starts):
        yield Progress((1 + index) / (2 + len(starts)), "{scheme} at many rates", start.scheme)
        refiner = Refiner(level, values, start, watched_items, FINEST, known_run=own)
        refine([refiner], REFINING, never)
        refinements += [refiner.refinement] if refiner.refinement else []
    if not refinements:
        return
    best = min(refinements, key=_reference_rank)
    steps = step_durations(
        level, values, *(refinement.traces[-1].stepping for refinement in refinements)
    )
    for refinement, step in zip(refinements, steps, strict=True):
        shown = refinement if refinement is best else relative_to(refinement, best, watched_items)
        yield from _curve(shown, step)


def _reference_rank(refinement: Refinement) -> tuple[bool, float]:
    """Return a key by which to sort, best first; stock pymunk's impacts agree only by chance."""
    last = refinement.traces[-1]
    naive = last.stepping.is_stock and last.level.effects.contact is not None
    return naive, refinement.errors[-1]


def _curve(refinement: Refinement, step: float) -> Iterator[WorkPrecisionPoint]:
    trace: Trace
    for trace, error in zip(refinement.traces, refinement.errors, strict=True):
        rate = trace.stepping.rate
        if isfinite(error):
            yield WorkPrecisionPoint(trace.stepping.scheme, rate, error, step * rate)


def _first_steppings(level: Level) -> Iterator[Stepping]:
    """Yield every scheme that the level can use, at a low rate."""
    for scheme in usable(level):
        update = {"scheme": scheme, "rate": lowest_doubled_rate(level.stepping.rate)}
        yield level.stepping.model_copy(update=update)
