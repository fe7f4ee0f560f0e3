"""What a step of a level takes, in the time of the processor."""

from dataclasses import dataclass
from functools import partial
from math import inf
from time import process_time

from sandbox.model.catalog import find
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World

REPEATS = 3
"""How often a run is timed at the most; the quickest counts, for whatever else runs only adds."""

MOST = 1.0
"""s, about, for the timing of a level."""

REAL_TIME = 0.5
"""The share of a core that a level may need; the rest is for drawing it."""


@dataclass(frozen=True, slots=True)
class Pace:
    """What a level needs at the rate that it ships with.

    Attributes
    ----------
    level
        Its name.
    rate
        Of its steps [Hz].
    step_seconds
        What a step takes of a processor, the mean of its run [s].
    load
        What a second of the scene takes [s], looked at sixty times.
    """

    level: str
    rate: float
    step_seconds: float
    load: float

    @property
    def in_time(self) -> bool:
        """Whether half of a core is enough."""
        return self.load <= REAL_TIME


def pace(name: str) -> Pace:
    """Measure a level from its start on, for its duration or as long as there is time.

    Raises
    ------
    SandboxError
        If there is no such level, or it does not run.
    """
    level = load(find(name))
    start = partial(build, level)
    seconds, steps, spent = inf, 1, 0.0
    for _ in range(REPEATS):
        begun = process_time()
        took, steps = _run(start())
        seconds, spent = min(seconds, took), spent + process_time() - begun
        if spent > MOST:
            break
    rate = start().stepping.rate
    return Pace(name, rate, seconds / steps, seconds / steps * rate)


def _run(world: World) -> tuple[float, int]:
    """Return what a run takes of a processor [s], as far as there is time, and how many steps."""
    look = max(round(world.stepping.rate / 60), 1)
    left, steps, begun = count_steps(world), 0, process_time()
    while steps < left and process_time() - begun < MOST:
        world.advance(min(look, left - steps))
        steps += min(look, left - steps)
    return process_time() - begun, max(steps, 1)
