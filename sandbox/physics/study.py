"""What the accuracy of a level is, what it is made of, and what more of it would cost.

A study is a row of findings, each told as soon as it is known, for somebody who looks on.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import zip_longest
from math import floor, isfinite, log2
from typing import get_args

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.physics.accuracy import Setting, calibrate
from sandbox.physics.accuracy.estimation import extrapolated
from sandbox.physics.accuracy.ladder import Ladder, climb, held_against
from sandbox.physics.accuracy.runs import Watched, never, record, scale, size, watched
from sandbox.physics.checks import Result, grade
from sandbox.physics.timing import step_seconds
from sandbox.physics.trace import Trace, count_steps
from sandbox.physics.world import build

CLIMB = 2.0
"""s, for the runs of one scheme; the one that is under way is not cut short."""

SLOWEST = 30.0
"""Hz, the lowest rate that is tried, or up to twice that."""

SEARCH = 4.0
"""s, for the runs that look for a setting."""

FINEST = 1e-10
"""No scheme climbs further: what is left is rounding."""

EXACT = 1e-10
"""What a formula is off by less than that at a small step is rounding, and no approximation."""

STEPS = 60
"""How many steps are timed."""


@dataclass(frozen=True, slots=True)
class Progress:
    """Which share is done, and what comes next."""

    share: float
    told: str


@dataclass(frozen=True, slots=True)
class Point:
    """A setting, its largest numerical error, and what a second of the scene costs [s]."""

    scheme: Scheme
    rate: float
    error: float
    price: float


@dataclass(frozen=True, slots=True)
class Here(Point):
    """The setting of the present run."""


@dataclass(frozen=True, slots=True)
class Split:
    """What the error of a check is made of; relative as a check's error is.

    Attributes
    ----------
    check
        Its index in the level.
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

    told: str


Finding = Progress | Point | Here | Split | Setting | Failed


def study(level: Level, values: Values) -> Iterator[Finding]:
    """Yield what other settings err and cost, then what the error of the run is made of."""
    try:
        yield from _others(level, values)
        yield from _own(level, values)
    except SandboxError as error:
        yield Failed(str(error))


def split(level: Level, values: Values) -> Iterator[Finding]:
    """Yield what the error of the run is made of."""
    try:
        yield from _own(level, values)
    except SandboxError as error:
        yield Failed(str(error))


def seek(level: Level, values: Values, target: float) -> Iterator[Finding]:
    """Yield the cheapest setting that reaches an accuracy."""
    try:
        yield Progress(0.1, "looking for the cheapest setting")
        yield calibrate(level, values, target, SEARCH)
    except SandboxError as error:
        yield Failed(str(error))


def _own(level: Level, values: Values) -> Iterator[Finding]:
    """Run at half the level's own rate, at that, and at twice that."""
    yield Progress(0.9, "halving the step")
    items = [Watched(check.quantity, check.at) for check in level.checks]
    items = items or list(watched(level, values))
    own = level.stepping
    traces = list(_halved(level, values, items))
    errors = [0.0]
    results = zip(grade(traces[-2]), grade(traces[-1]), strict=True)
    for index, (item, result) in enumerate(zip_longest(items, results)):
        found = extrapolated(traces, item)
        if found is None:
            continue
        unit = scale(size(traces[-1], item), found.of[-1])
        numerical, rest = found.of[-2] / unit, found.of[-1] / unit
        errors.append(numerical)
        if result:
            yield _split(index, result, found.of[-2], numerical, rest)
    price = _step(level, values, own) * own.rate
    yield Here(own.scheme, own.rate, max(errors), price)


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
    """Climb with each scheme, and hold all against the best."""
    starts = list(_starts(level, values))
    wanted = watched(level, values)
    ladders: list[Ladder] = []
    for index, start in enumerate(starts):
        yield Progress((1 + index) / (2 + len(starts)), f"{start.scheme} at many rates")
        ladder = climb(level, values, start, wanted, FINEST, CLIMB, never)
        ladders += [ladder] if ladder else []
    best = min(ladders, key=lambda ladder: ladder.errors[-1], default=None)
    for ladder in ladders:
        told = ladder if ladder is best or best is None else held_against(ladder, best, wanted)
        step = _step(level, values, ladder.traces[-1].stepping)
        yield from _points(told, step)


def _points(ladder: Ladder, step: float) -> Iterator[Point]:
    trace: Trace
    for trace, error in zip(ladder.traces, ladder.errors, strict=True):
        rate = trace.stepping.rate
        if isfinite(error):
            yield Point(trace.stepping.scheme, rate, error, step * rate)


def _starts(level: Level, values: Values) -> Iterator[Stepping]:
    """Yield every scheme that the level can use and that differs, at a low rate."""
    own = level.stepping
    rate = own.rate / 2 ** floor(log2(max(own.rate, SLOWEST) / SLOWEST))
    for scheme in get_args(Scheme):
        start = own.model_copy(update={"scheme": scheme, "rate": rate})
        try:
            world = build(level, values, own.model_copy(update={"scheme": scheme}))
        except SandboxError:
            continue  # it is not for this level
        if scheme != "explicit-euler" or world.scene.laws:  # else it is the other Euler's
            yield start


def _step(level: Level, values: Values, stepping: Stepping) -> float:
    """Return what a step costs [s]."""
    steps = min(count_steps(build(level, values, stepping)), STEPS)
    [seconds] = step_seconds([lambda: build(level, values, stepping).step], max(steps, 1), 3)
    return seconds
