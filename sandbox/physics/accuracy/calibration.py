"""The cheapest setting that reaches an accuracy, found by short runs.

Each scheme that is for the level climbs a ladder of rates, each twice the one before, until a run
agrees with finer ones to the accuracy that is asked for, or the time for it is spent; then the
order by which its errors fall tells how far it has to go. The cheapest of all is taken.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil, floor, inf, log2, log10
from time import thread_time

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.model.schemes import unsmooth
from sandbox.physics.accuracy.chaos import WILD, growth
from sandbox.physics.accuracy.errors import AccuracyError
from sandbox.physics.accuracy.ladder import FASTEST, SLOWEST, Ladder, climb, held_against
from sandbox.physics.accuracy.runs import Stop, Watched, never, watched
from sandbox.physics.checks import applies
from sandbox.physics.errors import SimulationError
from sandbox.physics.timing import step_seconds
from sandbox.physics.trace import count_steps
from sandbox.physics.world import build

BUDGET = 0.8
"""s, for all runs of a calibration; the one that is under way is not cut short."""

FIRST = 0.65
"""The share of the budget that the first of two schemes may have."""

FEW = 400
"""Steps of the first run, at the most: a long run begins with steps that no one would choose."""

CAUTION = 0.7
"""The share of the accuracy that a setting may use up by what is only expected of it."""

REAL_TIME = 0.5
"""s of computing for a second of the scene; the rest is for drawing it."""

FINEST = 1e-14
"""No run is that accurate: it is rounding."""

LONGEST = 4.0
"""Hz, or up to twice that: the rate at which it begins at the least."""

MORE_SWEEPS = 4
"""By how much more often the solver sweeps in the runs that judge it."""

_ENERGY = Watched("system.energy")

Progress = Callable[[float, str], None]
"""Is told which share is done, and what comes next."""


@dataclass(frozen=True, slots=True)
class Offer:
    """What can be had: a setting, its estimated error, and its price.

    Attributes
    ----------
    stepping
        The setting.
    error
        The largest of the run, as a check's: relative, absolute where zero is expected.
    price
        What a second of the scene takes to compute [s].
    """

    stepping: Stepping
    error: float
    price: float

    def __str__(self) -> str:
        s = self.stepping
        price = f"{self.price * 1e3:.2g} ms of computing for a second of the scene"
        return f"{s.scheme} at {s.rate:g} Hz, estimated error {self.error:.1e}, {price}"


@dataclass(frozen=True, slots=True)
class Setting:
    """The cheapest setting that reaches an accuracy.

    Attributes
    ----------
    target
        What was asked for.
    chosen
        The setting, its estimated error and its price.
    judged_by
        What the error is that of, in words.
    verified
        Whether runs with smaller steps were seen to agree; else it is what the order promises.
    in_real_time
        The most accurate setting that can be had in real time, where the chosen one cannot.
    """

    target: float
    chosen: Offer
    judged_by: str
    verified: bool
    in_real_time: Offer | None = None

    def __str__(self) -> str:
        told = f"accuracy {self.target:g}: {self.chosen}, judged by {self.judged_by}"
        if self.in_real_time is None:
            return told
        return f"{told}; not in real time, in which there is {self.in_real_time}"


def calibrate(
    level: Level,
    values: Values | None = None,
    target: float = 1e-6,
    budget: float = BUDGET,
    progress: Progress | None = None,
    stop: Stop = never,
) -> Setting:
    """Return the cheapest setting with which a run reaches an accuracy.

    Parameters
    ----------
    level, values
        What is run; the level's default values if left out.
    target
        The largest error that the quantities of the level's checks may have, or, where it has none,
        the places and velocities of its bodies.
    budget
        How long it may take, about [s].
    progress
        Is told how far it is.
    stop
        Is asked now and then whether to give up.

    Raises
    ------
    AccuracyError
        If the accuracy cannot be had, or there is nothing whose accuracy it could be.
    Cancelled
        If `stop` said so.
    SimulationError
        If the level does not run at all.
    """
    values = level.defaults if values is None else values
    wanted = watched(level, values)
    if not wanted:
        raise AccuracyError("nothing moves freely, so there is nothing to be accurate")
    if not target >= FINEST:
        raise AccuracyError(f"an accuracy of {target:g} is below rounding; {FINEST:g} is the least")
    checked = any(applies(check, values) for check in level.checks)
    judged_by = "its checks" if checked else "places and velocities"
    ladders = _ladders(level, values, wanted, target, budget, progress, stop)
    offers = _offers(level, values, ladders, target)
    if (
        offers[0][1].error > target
        and (times := growth(level, values, _seen(ladders), stop)) > WILD
    ):
        judged_by = f"its energy, for it is chaotic: a small change grows {times:.0e} times"
        ladders = _ladders(level, values, (_ENERGY,), target, budget, progress, stop)
        offers = _offers(level, values, ladders, target)
    verified, chosen = offers[0]
    if chosen.error > target:
        raise AccuracyError(
            f"an accuracy of {target:g} cannot be had; there is {chosen}, judged by {judged_by}"
        )
    offer = None if chosen.price <= REAL_TIME else _affordable(level, values, ladders)
    return Setting(target, chosen, judged_by, verified, offer)


def _seen(ladders: list[Ladder]) -> Stepping:
    """Return the finest setting that was run."""
    return ladders[-1].traces[-1].stepping


def _candidates(level: Level, values: Values) -> Iterator[Stepping]:
    """Yield what is tried, from its lowest rate on; the best judge of the others first."""
    rate = level.stepping.rate
    rate /= 2 ** floor(log2(max(rate, SLOWEST) / SLOWEST))
    while rate * level.duration(values) > FEW and rate > LONGEST:
        rate /= 2
    start = Stepping(rate=rate, iterations=level.stepping.iterations)
    if not unsmooth(level):
        yield start.model_copy(update={"scheme": "yoshida", "rate": rate / 2})
    elif level.effects.contact:
        yield start.model_copy(update={"iterations": min(MORE_SWEEPS * start.iterations, 1000)})
    yield start


def _ladders(
    level: Level,
    values: Values,
    wanted: tuple[Watched, ...],
    target: float,
    budget: float,
    progress: Progress | None,
    stop: Stop,
) -> list[Ladder]:
    """Climb with each candidate, and hold all against the best."""
    candidates = list(_candidates(level, values))
    found: list[Ladder] = []
    end = thread_time() + budget
    for index, start in enumerate(candidates):
        if progress:
            progress(index / len(candidates), f"{start.scheme}, {start.iterations} sweeps")
        left = end - thread_time()
        share = left if start is candidates[-1] else left * FIRST
        try:
            ladder = climb(level, values, start, wanted, target * CAUTION, share, stop)
        except SimulationError:
            if start is candidates[-1] and not found:
                raise
            continue
        if ladder:
            found.append(ladder)
    if not found:
        raise AccuracyError("the level takes too long to run for its accuracy to be found out")
    best, *others = sorted(found, key=lambda ladder: ladder.errors[-1])
    if level.effects.contact:
        best, *others = found  # only more sweeps of the solver show what it still owes
    return [best, *(held_against(ladder, best, wanted) for ladder in others)]


def _offers(
    level: Level, values: Values, ladders: list[Ladder], target: float
) -> list[tuple[bool, Offer]]:
    """Return what each ladder has to offer, and whether it was seen to be so good.

    What reaches the target comes first, the cheapest of it before all; then what is most accurate.
    """
    found = [_offer(_step_seconds(level, values, ladder), ladder, target) for ladder in ladders]

    def rank(offer: tuple[bool, Offer]) -> tuple[float, float]:
        return max(offer[1].error, target), offer[1].price

    return sorted(found, key=rank)


def _offer(step: float, ladder: Ladder, target: float) -> tuple[bool, Offer]:
    """Return a ladder's cheapest setting, or its best, at a price a step [s]."""
    if good := ladder.cheapest(target):
        trace, error = good
        return True, Offer(trace.stepping, error, step * trace.stepping.rate)
    rate = _rounded(max(ladder.rate_for(target * CAUTION), SLOWEST))
    if rate <= FASTEST:
        setting = ladder.traces[-1].stepping.at(rate)
        return False, Offer(setting, ladder.error_at(rate), step * rate)
    runs = zip(ladder.traces, ladder.errors, strict=True)
    trace, error = min(runs, key=lambda run: run[1])
    return True, Offer(trace.stepping, error, step * trace.stepping.rate)


def _affordable(level: Level, values: Values, ladders: list[Ladder]) -> Offer | None:
    """Return the most accurate setting that runs in real time."""
    found = []
    for ladder in ladders:
        step = _step_seconds(level, values, ladder)
        fastest = REAL_TIME / step
        runs = [
            Offer(trace.stepping, error, step * trace.stepping.rate)
            for trace, error in zip(ladder.traces, ladder.errors, strict=True)
            if SLOWEST <= trace.stepping.rate <= fastest
        ]
        last = ladder.traces[-1].stepping
        if fastest > last.rate:
            rate = float(floor(fastest))
            setting = last.model_copy(update={"rate": rate})
            runs.append(Offer(setting, ladder.error_at(rate), step * rate))
        found += runs
    return min(found, key=lambda offer: offer.error, default=None)


def _step_seconds(level: Level, values: Values, ladder: Ladder) -> float:
    """Return what a step costs [s]."""
    stepping = ladder.traces[-1].stepping
    steps = min(count_steps(build(level, values, stepping)), 60)
    [seconds] = step_seconds([lambda: build(level, values, stepping).step], max(steps, 1), 3)
    return seconds


def _rounded(rate: float) -> float:
    """Return a rate rounded up to three digits [Hz]."""
    if rate == inf:
        return rate
    unit = 10.0 ** (ceil(log10(rate)) - 3)
    return ceil(rate / unit) * unit
