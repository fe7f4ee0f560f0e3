"""Frontiers: the difficulty at which a scene breaks its bound, here and in stock pymunk.

pymunk gets the cost of the sandbox's step at the same difficulty, and takes as many steps as it can
for that. Both are timed on the same machine, one after the other.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf, isnan, nan, sqrt
from time import process_time

import numpy as np

from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from validation.stability.hard_case import Frontier, figure_of, make, watch
from validation.stability.run_measures import Run
from validation.stability.stock_pymunk import naive

GALLOPS = 7
"""The number of leaps from the least difficulty to the greatest."""

CLOSE = 1.08
"""The ratio of a difficulty that breaks to one that holds at which the search ends."""

BLOCKS = 16
"""The number of timed blocks of ten steps."""

QUICK_TIME = 20.0
"""The length of an endurance run in a quick run [s]."""


@dataclass(frozen=True, slots=True)
class Reach:
    """The position of a frontier."""

    difficulty: float
    """The greatest difficulty that holds; 0 if not even the least does."""
    figure: float
    """The figure of the run there."""
    cost: float
    """The computing time per second of the scene there [s]."""
    rate: float
    """The rate of the steps there [Hz]."""


def reach(frontier: Frontier, *, alone: bool = False) -> Reach:
    """Search for a frontier; if `alone`, pymunk does everything, at the sandbox's cost."""
    if frontier.over_time:
        return _lasts(frontier, alone=alone)
    found: dict[float, Reach] = {}

    def holds(difficulty: float) -> bool:
        found[difficulty] = trial(frontier, difficulty, alone=alone)
        return found[difficulty].figure <= frontier.bound

    best = furthest(holds, frontier.start, frontier.end, whole=frontier.whole)
    return found[best] if best else replace(found[frontier.start], difficulty=0.0)


def furthest(
    holds: Callable[[float], bool], start: float, end: float, *, whole: bool = False
) -> float:
    """Return the greatest difficulty that holds, below the first one that fails; 0 if none holds.

    Leaps of equal ratios increase the difficulty until one fails; the last interval is then
    bisected geometrically until its ratio is below `CLOSE` or, for whole numbers, its length is 1.
    """
    if not holds(start):
        return 0.0
    good, bad = start, inf
    for ahead in _leaps(start, end, whole=whole):
        if not holds(ahead):
            bad = ahead
            break
        good = ahead
    while bad < inf and ((bad - good > 1) if whole else (bad / good > CLOSE)):
        middle = float((good + bad) // 2) if whole else sqrt(good * bad)
        good, bad = (middle, bad) if holds(middle) else (good, middle)
    return good


def _leaps(start: float, end: float, *, whole: bool) -> list[float]:
    """Return increasing difficulties above the least, in equal ratios, up to the greatest."""
    ways = [start * (end / start) ** (i / GALLOPS) for i in range(1, GALLOPS)]
    ahead = {float(round(way)) for way in ways} - {start} if whole else set(ways)
    return sorted({*ahead, end})


def trial(frontier: Frontier, difficulty: float, *, alone: bool = False) -> Reach:
    """Run a scene at a difficulty."""
    level = make(frontier.scene(difficulty))
    world, rate, cost = _entrant(frontier, level, alone=alone)
    figure, _, _ = figure_of(frontier.figure, lambda: watch(level, world(), frontier.duration))
    return Reach(difficulty, figure, cost, rate)


def _entrant(
    frontier: Frontier, level: Level, *, alone: bool
) -> tuple[Callable[[], World], float, float]:
    """Return the maker of the world, its rate [Hz], and the time per second of the scene [s]."""
    rate = level.stepping.rate
    cost = step_cost(lambda: build(level))
    if isnan(cost):  # refused at once: the easiest scene sets the budget
        cost = step_cost(lambda: build(make(frontier.scene(frontier.start))))
    if not alone:
        return lambda: build(level), rate, cost * rate
    at_same_rate = step_cost(lambda: naive(level, rate))
    more = cost / at_same_rate if cost and at_same_rate else 1.0  # some clocks are too coarse
    steps = min(rate * more, HIGHEST_RATE)
    return lambda: naive(level, steps), steps, at_same_rate * steps


def step_cost(start: Callable[[], World]) -> float:
    """Return the time of a step [s]: the lower quartile over blocks of ten steps.

    A run that has to stop is timed up to there; its cost is NaN if that is too short.
    """
    blocks = []
    with suppress(SimulationError):
        world = start()
        for _ in range(BLOCKS):
            begin = process_time()
            for _ in range(10):
                world.step()
            blocks.append(process_time() - begin)
    return float(np.quantile(blocks, 0.25) / 10) if blocks else nan


def _lasts(frontier: Frontier, *, alone: bool) -> Reach:
    """Return the time until which the bound holds."""
    level = make(frontier.scene(frontier.end))
    world, rate, cost = _entrant(frontier, level, alone=alone)
    _, run, _ = figure_of(frontier.figure, lambda: watch(level, world(), frontier.end))
    if run is None:
        return Reach(0.0, inf, cost, rate)
    low, high = 1, len(run.states.t)
    while high - low > 1:
        middle = (low + high) // 2
        good = frontier.figure(_until(run, middle)) <= frontier.bound
        low, high = (middle, high) if good else (low, middle)
    whole = frontier.figure(run) <= frontier.bound
    last = len(run.states.t) if whole else low
    figure = frontier.figure(_until(run, last))
    return Reach(frontier.end if whole else float(run.states.t[last - 1]), figure, cost, rate)


def _until(run: Run, count: int) -> Run:
    """Return the first instants of a run."""
    states = {name: getattr(run.states, name)[:count] for name in Snapshot.__dataclass_fields__}
    return run._replace(states=Snapshot(**states))
