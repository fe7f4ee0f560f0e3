"""Measures the cost of a step, without the noise of the machine."""

from collections.abc import Callable, Sequence
from itertools import chain, count, cycle, islice
from math import inf
from time import perf_counter

import numpy as np

from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.stepping.world import World

Step = Callable[[], object]

REPEATS = 5
"""The number of repetitions of each timed run."""

STEPS = 120
"""The most steps of a timed run, in blocks of `BLOCK`."""

ENOUGH = 0.5
"""The time after which a quick measurement is not repeated [s]."""

BLOCK = 10
"""The steps timed together: long for the clock's resolution, short against disturbances."""


def step_seconds(
    starts: Sequence[Callable[[], Step]],
    steps: int = STEPS,
    repeats: int = REPEATS,
    enough: float = inf,
) -> list[float]:
    """Return the least time of a step of each of several scenes [s], which run in turn.

    Each run is divided into blocks, and the fastest repetition of each block counts: disturbances
    only add time. Each start makes a new scene and returns a function that takes one step. After a
    time that is `enough` [s] no repetition begins.
    """
    block = min(BLOCK, steps)
    count = max(steps // block, 1)
    shortest, started = np.full((len(starts), count), inf), perf_counter()
    for index in islice(cycle(range(len(starts))), repeats * len(starts)):
        if index == 0 and np.isfinite(shortest[0, 0]) and perf_counter() - started > enough:
            break
        step = starts[index]()
        for number in range(count):
            begin = perf_counter()
            for _ in range(block):
                step()
            shortest[index, number] = min(shortest[index, number], perf_counter() - begin)
    return [float(row.sum()) / (count * block) for row in shortest]


def step_costs(
    *starts: Callable[[], World], most: int = STEPS, repeats: int = REPEATS, enough: float = inf
) -> tuple[float, ...]:
    """Return the time of a step of some worlds [s], which run in turn from their starts.

    At most `most` steps are taken, and no world goes beyond the duration of its level. After a time
    that is `enough` [s] they are not taken again. Raises `SimulationError` if one of them stops.
    """
    first = [start() for start in starts]
    steps = max(min(most, *map(count_steps, first)), 1)
    fresh = [_stepping(world, start) for world, start in zip(first, starts, strict=True)]
    return tuple(step_seconds(fresh, steps, repeats, enough))


def _stepping(first: World, start: Callable[[], World]) -> Callable[[], Step]:
    """Return a maker of steps that uses the given first world, as some take long to build."""
    worlds = chain([first], (start() for _ in count()))
    return lambda: next(worlds).step


def brief_costs(*starts: Callable[[], World]) -> tuple[float, ...]:
    """Return the cost of a step of some worlds [s], measured quickly."""
    return step_costs(*starts, most=60, repeats=3, enough=ENOUGH)
