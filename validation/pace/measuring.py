"""The processor time of a level's step."""

from dataclasses import dataclass
from functools import partial
from math import inf
from time import process_time

from sandbox.model.catalog import find
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from validation.pace.machine_speed import REFERENCE, yardstick

REPEATS = 3
"""How often a run is timed, at most; the fastest counts, since disturbances only add."""

MOST = 1.0
"""s, about, for the timing of a level."""

SLICE = 0.05
"""s, about, between two measurements of the machine's speed."""

REAL_TIME = 0.5
"""The share of the reference core that a level may need; the rest is for drawing."""


@dataclass(frozen=True, slots=True)
class Pace:
    """What a level needs at the rate that it ships with.

    Attributes
    ----------
    level
        The name of the level.
    rate
        Of its steps [Hz].
    step_seconds
        What a step takes of a processor, the mean of its run [s].
    load
        What a second of the scene takes here and now [s], looked at sixty times.
    reference_load
        The time on the reference core; see `yardstick` [s].
    """

    level: str
    rate: float
    step_seconds: float
    load: float
    reference_load: float

    @property
    def in_time(self) -> bool:
        """Whether half of the reference core is enough."""
        return self.reference_load <= REAL_TIME


def pace(name: str) -> Pace:
    """Measure a level from its start on, for its duration or as long as there is time.

    Raises
    ------
    SandboxError
        If there is no such level, or it does not run.
    """
    level = load(find(name))
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
    """Return what a run takes of a processor [s], as far as there is time, and how many steps.

    In between: what it would take of the reference core [s].
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
    """Take steps for a while; return how many, and what they took of a processor [s]."""
    look = max(round(world.stepping.rate / 60), 1)
    steps, begun = 0, process_time()
    while steps < left and process_time() - begun < SLICE:
        world.advance(min(look, left - steps))
        steps += min(look, left - steps)
    return steps, process_time() - begun
