"""The sweep: a level with every scheme, at every rate."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import inf, nan
from time import perf_counter

from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.model.quantities import TIME
from sandbox.physics.accuracy.compared_runs import motion
from sandbox.physics.accuracy.error_causes_and_costs import trusted
from sandbox.physics.accuracy.requested_accuracy import BUDGET
from sandbox.physics.accuracy.trusted_digits import Trust, least_known
from sandbox.physics.measuring.recording import Trace, count_steps
from sandbox.physics.run import build
from sandbox.physics.scene.usable_schemes import usable
from sandbox.physics.state.simulation_errors import SimulationError
from validation.cost_of_accuracy.accuracy_requests import Request, ask, costs
from validation.cost_of_accuracy.run_error import Yardstick, run, yardstick

RATES = tuple(15.0 * 2**i for i in range(10))
"""The rates of the sweep [Hz]: 15 to 7,680."""

ITERATIONS = (4, 10, 40)
"""The solver iterations that are tried for levels with contact; others need no solver."""

NAIVE: Scheme = "symplectic-euler"
OURS: Scheme = "leapfrog"


@dataclass(frozen=True, slots=True)
class Budget:
    """The limits of a sweep."""

    run: float = 1.0
    """The time that one run may take, about [s]."""
    rates: Sequence[float] = RATES
    """The rates that are tried in addition to the level's own [Hz]."""
    targets: Sequence[float] = (1e-3, 1e-5, 1e-7)
    """The accuracies to request."""
    calibration: float = BUDGET
    """The time that the calibration of one may take [s]."""


QUICK = Budget(run=0.08, rates=RATES[1::3], targets=(1e-4,), calibration=0.1)


@dataclass(frozen=True, slots=True)
class Point:
    """A setting, with its error and cost."""

    scheme: Scheme
    rate: float
    iterations: int
    """The setting; `symplectic-euler` is stock pymunk."""
    error: float
    """The largest error of the run; infinite if an event never occurred, NaN if the run failed."""
    seconds_per_second: float
    """The computing time per second of the scene [s]."""
    steps: int
    callbacks: int
    """The number of Python calls in these steps."""
    failure: str | None = None
    """Why the run stopped, if it did."""

    @property
    def stepping(self) -> Stepping:
        """The setting."""
        return Stepping(rate=self.rate, iterations=self.iterations, scheme=self.scheme)


@dataclass(frozen=True, slots=True)
class Sweep:
    """The points of a level; the costs are NaN until they are timed."""

    level: str
    judged_by: str
    quantities: tuple[str, ...]
    """The reference of the errors, and the quantities that have them."""
    own_rate: float
    """The level's own rate [Hz]."""
    points: tuple[Point, ...]
    requests: tuple[Request, ...] = ()
    """The settings that were tried, and the requests for an accuracy."""
    failure: str = ""
    """Why the level does not run at its own rate; empty if it does."""
    trusted: tuple[Trust, ...] = ()
    """The trusted digits at that rate, of the least known position and of the quantities."""


def errors(name: str, budget: Budget) -> Sweep:
    """Run a level with every setting that the budget allows, and record the errors."""
    level = load(find(name))
    try:
        stick = yardstick(level, level.defaults, budget.run)
    except SimulationError as error:
        return Sweep(name, "nothing", (), level.stepping.rate, (), failure=str(error))
    if stick is None:
        return Sweep(name, "nothing: the level has no check", (), level.stepping.rate, ())
    points = tuple(_points(level, stick, budget))
    requests = tuple(ask(name, level, stick, budget.targets, budget.calibration))
    return Sweep(
        name, stick.kind, stick.quantities, level.stepping.rate, points, requests,
        trusted=digits(level, stick.quantities),
    )  # fmt: skip


def _points(level: Level, stick: Yardstick, budget: Budget) -> Iterator[Point]:
    own = stick.own.stepping
    for scheme, iterations in _solvers(level):
        seconds, last = 0.0, inf
        for rate in sorted({*budget.rates, own.rate}):
            stepping = Stepping(rate=rate, iterations=iterations, scheme=scheme)
            if stepping == own:
                yield _seen(stick, stick.own)
                continue
            always = rate == own.rate and scheme == NAIVE
            if seconds * rate / last > budget.run and not always:
                continue
            start = perf_counter()
            yield _point(level, stick, stepping)
            seconds, last = perf_counter() - start, rate


def _solvers(level: Level) -> Iterator[tuple[Scheme, int]]:
    """Yield the schemes and solver iterations that make a difference to a level."""
    own = level.stepping.iterations
    sweeps = sorted({*ITERATIONS, own}) if level.effects.contact else [own]
    return product(usable(level), sweeps)


def _point(level: Level, stick: Yardstick, stepping: Stepping) -> Point:
    try:
        trace = run(level, level.defaults, stepping)
    except SimulationError as error:
        return Point(
            stepping.scheme, stepping.rate, stepping.iterations, nan, nan, 0, 0, str(error)
        )
    return _seen(stick, trace)


def _seen(stick: Yardstick, trace: Trace) -> Point:
    """Return the point of a run, without its cost."""
    s, world = trace.stepping, build(trace.level, stepping=trace.stepping)
    steps = count_steps(world)
    calls = world.hooks * steps
    return Point(s.scheme, s.rate, s.iterations, stick.error(trace), nan, steps, calls)


def timed(sweep: Sweep) -> Sweep:
    """Return a sweep with its costs, each measured in new worlds, apart from the errors."""
    level = load(find(sweep.level))
    points = tuple(_timed(point, level) for point in sweep.points)
    requests = tuple(_with_costs(request, points, level) for request in sweep.requests)
    return replace(sweep, points=points, requests=requests)


def _with_costs(request: Request, points: Sequence[Point], level: Level) -> Request:
    """Return a request with its cost, and that of the cheapest point with as small an error."""
    good = (p for p in points if p.error <= request.target)
    best = min(good, key=lambda point: point.seconds_per_second, default=None)
    if request.stepping is None:
        return replace(request, cheapest=best.seconds_per_second if best else inf)
    if best is None:
        return replace(request, cost=costs(level, request.stepping)[0])
    paid, cheapest = costs(level, request.stepping, best.stepping)
    return replace(request, cost=paid, cheapest=cheapest)


def _timed(point: Point, level: Level) -> Point:
    if point.failure:
        return point
    [cost] = costs(level, point.stepping)
    return replace(point, seconds_per_second=cost)


def digits(level: Level, quantities: Iterable[str]) -> tuple[Trust, ...]:
    """Return the trust in some quantities, preceded by that in the least known position.

    Empty if the level does not run with half of its step.
    """
    checked = [name for name in dict.fromkeys(quantities) if name != TIME.name]
    places = [item.quantity for item in motion(level) if ".position." in item.quantity]
    try:
        found = trusted(level, level.defaults, dict.fromkeys((*places, *checked)))
    except SimulationError:
        return ()
    least = least_known(trust for trust in found if trust.quantity in places)
    rest = [trust for trust in found if trust.quantity in checked and trust is not least]
    return (*([least] if least else []), *rest)
