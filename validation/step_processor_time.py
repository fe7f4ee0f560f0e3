"""`python -m validation pace`: the processor time of each level's step.

A core is half as fast while its twin is busy, and machines differ by more. Loads are therefore also
given for a reference machine: the measured time, divided by the time of the yardstick beside it,
times the yardstick's time on that machine.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from pathlib import Path
from time import process_time

import numpy as np
from rich.table import Table

from sandbox import progress_bar
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from validation import output

REFERENCE = 3.05e-3
"""The time of the yardstick on an idle core of the reference machine [s]: a slow one, two cores of
a shared server."""

ROUNDS = 60
"""The repetitions of the yardstick's work."""

SIZE = 12
"""The rows of its matrices: about as many as a linkage has."""

_MATRIX = np.eye(SIZE) * SIZE + np.cos(np.arange(SIZE**2)).reshape(SIZE, SIZE)
_VECTOR = np.sin(np.arange(SIZE))

REPEATS = 3
"""The most timings of a run; the fastest counts, since disturbances only add time."""

MOST = 1.0
"""The time for measuring a level, about [s]."""

SLICE = 0.05
"""The time between two measurements of the machine's speed, about [s]."""

REAL_TIME = 0.5
"""The share of the reference core that a level may need; the rest is for drawing."""


@dataclass(frozen=True, slots=True)
class Pace:
    """The load of a level at its own rate."""

    level: str
    """The name of the level."""
    rate: float
    """The rate of its steps [Hz]."""
    step_seconds: float
    """The processor time of a step, averaged over its run [s]."""
    load: float
    """The present processor time per second of the scene [s], including sixty observations."""
    reference_load: float
    """The same on the reference core; see `yardstick` [s]."""

    @property
    def in_time(self) -> bool:
        """Whether half of the reference core is enough."""
        return self.reference_load <= REAL_TIME


def pace(name: str) -> Pace:
    """Measure a level from its start, for its duration or for as long as the time allows.

    Raises `SandboxError` if there is no such level, or it does not run.
    """
    level = load(level_catalog.find(name))
    start = partial(build, level)
    seconds = least = inf
    steps, spent = 1, 0.0
    for _ in range(REPEATS):
        begun = process_time()
        took, calibrated, steps = _run(start())
        seconds, least = min(seconds, took / steps), min(least, calibrated / steps)
        spent += process_time() - begun
        if spent > MOST:
            break
    rate = start().stepping.rate
    return Pace(name, rate, seconds, seconds * rate, least * rate)


def _run(world: World) -> tuple[float, float, int]:
    """Return the processor time of a run, that on the reference core [s], and the number of steps.

    The run ends early if its time is up.
    """
    left, steps, took, calibrated = count_steps(world), 0, 0.0, 0.0
    before = yardstick()
    while steps < left and took < MOST:
        count, seconds = _slice(world, left - steps)
        after = yardstick()
        calibrated += seconds * 2 * REFERENCE / (before + after)
        steps, took, before = steps + count, took + seconds, after
    return took, calibrated, max(steps, 1)


def _slice(world: World, left: int) -> tuple[int, float]:
    """Take steps for a while; return their number, and their processor time [s]."""
    look = max(round(world.stepping.rate / 60), 1)
    steps, begun = 0, process_time()
    while steps < left and process_time() - begun < SLICE:
        world.advance(min(look, left - steps))
        steps += min(look, left - steps)
    return steps, process_time() - begun


def yardstick() -> float:
    """Return the present processor time of the yardstick [s].

    Its work resembles that of steps: arithmetic in Python, numpy on small arrays, small systems.
    """
    begun = process_time()
    found, place = _VECTOR, 1.0
    for _ in range(ROUNDS):
        found = np.linalg.solve(_MATRIX, _VECTOR + found)
        found = np.where(found > 0, np.abs(found), found * 0.5)
        found = np.concatenate((found[1:], found[:1])) + _MATRIX.dot(_VECTOR).take(0)
        for turn in range(100):
            place = 0.5 * place + abs(place - turn) / (1.0 + place * place)
        found = np.clip(found, -1.0, place)
    return process_time() - begun


def measure(names: Sequence[str], json_file: Path | None) -> list[str]:
    """Measure levels, print the table, write it if asked to, and return the slow levels.

    Raises `SandboxError` if there is no such level, it does not run, or the file cannot be written.
    """
    names = list(names) or level_catalog.names()
    for name in names:
        level_catalog.find(name)
    found = progress_bar.consume(map(pace, names), "Measuring what levels need", len(names))
    with output.written(output.content(levels=found), json_file):
        output.show(table(found))
    slow = [each.level for each in found if not each.in_time]
    output.complain(slow)
    return slow


def table(found: Sequence[Pace]) -> Table:
    """Return the load of each level, the highest first, as a table for the terminal."""
    headings = ("rate", "a step", "of this core", "of the reference", "")
    shown = output.table("What levels need", "level", headings)
    for each in sorted(found, key=lambda pace: -pace.reference_load):
        shown.add_row(
            each.level,
            f"{each.rate:g} Hz",
            f"{each.step_seconds * 1e6:.3g} µs",
            f"{100 * each.load:.2g} %",
            f"{100 * each.reference_load:.2g} %",
            output.mark(passed=each.in_time),
        )
    return shown
