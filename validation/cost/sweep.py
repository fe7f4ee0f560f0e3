"""Running a level with every scheme, at every rate."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, nan
from time import perf_counter
from typing import get_args

from sandbox.model.catalog import find
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.loading import load
from sandbox.model.schemes import unsmooth
from sandbox.physics.accuracy.calibration import BUDGET
from sandbox.physics.errors import SimulationError
from sandbox.physics.timing import STEPS, step_seconds
from sandbox.physics.trace import count_steps, needed, simulate
from sandbox.physics.world import build
from validation.cost.requests import Request, ask, price
from validation.cost.yardstick import Yardstick, yardstick

RATES = tuple(15.0 * 2**i for i in range(10))
"""Hz, 15 to 7,680."""

ITERATIONS = (4, 10, 40)
"""Sweeps of the solver that are tried where bodies touch; elsewhere there is nothing to solve."""

NAIVE: Scheme = "symplectic-euler"
OURS: Scheme = "leapfrog"


@dataclass(frozen=True, slots=True)
class Budget:
    """How much a sweep may spend.

    Attributes
    ----------
    run
        How long one run may take, about [s].
    rates
        The rates that are tried besides the level's own [Hz].
    targets
        The accuracies that are asked for.
    calibration
        How long it may take to find out a setting for one [s].
    """

    run: float = 1.0
    rates: Sequence[float] = RATES
    targets: Sequence[float] = (1e-3, 1e-5, 1e-7)
    calibration: float = BUDGET


QUICK = Budget(run=0.08, rates=RATES[1::3], targets=(1e-4,), calibration=0.1)


@dataclass(frozen=True, slots=True)
class Point:
    """One setting, its error, and its price.

    Attributes
    ----------
    scheme, rate, iterations
        The setting; `symplectic-euler` is pymunk used naively.
    error
        The largest of the run; infinite if an event never came, NaN if the run failed.
    seconds_per_second
        What a second of simulated time costs [s].
    steps
        How many the run took.
    callbacks
        How many calls of Python they made.
    failure
        Why the run stopped, if it did.
    """

    scheme: Scheme
    rate: float
    iterations: int
    error: float
    seconds_per_second: float
    steps: int
    callbacks: int
    failure: str | None = None


@dataclass(frozen=True, slots=True)
class Sweep:
    """A level's points, without their prices as long as these are NaN."""

    level: str
    judged_by: str
    quantities: tuple[str, ...]
    own_rate: float
    points: tuple[Point, ...]
    requests: tuple[Request, ...] = ()


def errors(name: str, budget: Budget) -> Sweep:
    """Run a level with every setting that the budget allows, and note the errors."""
    level = load(find(name))
    try:
        stick = yardstick(level, level.defaults, budget.run)
    except SimulationError as error:
        return Sweep(name, f"nothing: {error}", (), level.stepping.rate, ())
    if stick is None:
        return Sweep(name, "nothing: the level has no check", (), level.stepping.rate, ())
    points = tuple(_points(level, stick, budget))
    requests = tuple(ask(name, level, stick, budget.targets, budget.calibration))
    return Sweep(name, stick.kind, stick.quantities, level.stepping.rate, points, requests)


def _points(level: Level, stick: Yardstick, budget: Budget) -> Iterator[Point]:
    rates = sorted({*budget.rates, level.stepping.rate})
    for scheme, iterations in _solvers(level):
        seconds, last = 0.0, rates[0]
        for rate in rates:
            if seconds * rate / last > budget.run and rate != level.stepping.rate:
                continue
            start = perf_counter()
            yield _point(level, stick, Stepping(rate=rate, iterations=iterations, scheme=scheme))
            seconds, last = perf_counter() - start, rate


def _solvers(level: Level) -> Iterator[tuple[Scheme, int]]:
    """Yield the schemes, and the sweeps of the solver, that make a difference to a level."""
    laws = build(level).scene.laws
    for scheme in get_args(Scheme):
        if scheme == "yoshida" and unsmooth(level):
            continue
        if scheme == "explicit-euler" and not laws:
            continue  # without a law of force it is what pymunk does
        for iterations in ITERATIONS if level.effects.contact else (level.stepping.iterations,):
            yield scheme, iterations


def _point(level: Level, stick: Yardstick, stepping: Stepping) -> Point:
    nothing = float("nan")
    setting = stepping.scheme, stepping.rate, stepping.iterations
    try:
        trace = simulate(level, record=needed(level), stepping=stepping)
        hooks = build(level, stepping=stepping).hooks
    except SimulationError as error:
        return Point(*setting, nothing, nothing, 0, 0, str(error))
    steps = len(trace.t) - 1
    return Point(*setting, stick.error(trace), nothing, steps, hooks * steps)


def timed(sweep: Sweep) -> Sweep:
    """Return a sweep with its prices, each measured in fresh worlds apart from the errors."""
    level = load(find(sweep.level))
    points = tuple(_timed(point, level) for point in sweep.points)
    requests = tuple(_priced(request, points, level) for request in sweep.requests)
    return replace(sweep, points=points, requests=requests)


def _priced(request: Request, points: Sequence[Point], level: Level) -> Request:
    """Return a request with its price, and that of the cheapest point that comes as close."""
    good = (p.seconds_per_second for p in points if p.error <= request.target)
    paid = price(level, request.stepping) if request.stepping else nan
    return replace(request, price=paid, cheapest=min(good, default=inf))


def _timed(point: Point, level: Level) -> Point:
    if point.failure:
        return point
    stepping = Stepping(rate=point.rate, iterations=point.iterations, scheme=point.scheme)
    steps = max(min(count_steps(build(level, stepping=stepping)), STEPS), 1)
    (seconds,) = step_seconds([lambda: build(level, stepping=stepping).step], steps)
    return replace(point, seconds_per_second=seconds * point.rate)
