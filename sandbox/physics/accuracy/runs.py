"""Runs that are held against each other, and what is watched in them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil, log2

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import ContactEvent, Instant, Level, Stepping
from sandbox.model.quantities import quantity
from sandbox.physics.accuracy.errors import Cancelled
from sandbox.physics.checks import ZERO, applies, samples
from sandbox.physics.trace import Recorder, Trace, count_steps, needed_at
from sandbox.physics.world import build

Stop = Callable[[], bool]
"""Tells whether somebody has lost patience."""

BLOCK = 50
"""Looks at a run between two questions of that kind."""

SEEN = 240.0
"""Hz, how often a run is looked at, or up to twice that: a look costs more than a step."""

SAME = 1e-9
"""Times that differ by this share are the same."""


@dataclass(frozen=True, slots=True)
class Watched:
    """A quantity of which the error is estimated, at every step or at an instant."""

    quantity: str
    at: Instant | None = None


def watched(level: Level, values: Values) -> tuple[Watched, ...]:
    """Return what the checks that apply measure; if there are none, where bodies are, how fast."""
    checked = (Watched(c.quantity, c.at) for c in level.checks if applies(c, values))
    return tuple(dict.fromkeys(checked)) or tuple(_motion(level))


def _motion(level: Level) -> Iterator[Watched]:
    parts = ["position.x", "position.y", "velocity.x", "velocity.y"]
    parts += ["angle", "angular_velocity"] if level.effects.rotation else []
    for name, body in level.bodies.items():
        if body.type == "dynamic":
            yield from (Watched(f"{name}.{part}") for part in parts)


def never() -> bool:
    """Return that nobody has lost patience."""
    return False


def record(
    level: Level,
    values: Values,
    stepping: Stepping,
    wanted: Sequence[Watched],
    stop: Stop = never,
) -> Trace:
    """Run a level for its duration and record what is watched.

    Raises
    ------
    Cancelled
        If `stop` says so.
    SimulationError
        If the run had to stop.
    """
    world = build(level, values, stepping)
    names = dict.fromkeys(name for item in wanted for name in needed_at(item.quantity, item.at))
    recorder = Recorder(world, names)
    stride = 1 if any(_needs_all(level, item) for item in wanted) else _stride(stepping.rate)
    for look in range(ceil(count_steps(world) / stride)):
        if look % BLOCK == 0 and stop():
            raise Cancelled
        world.advance(stride)
        recorder.note()
    return recorder.trace


def _stride(rate: float) -> int:
    """Return how many steps are taken at a time: a power of two, so that runs share instants."""
    return 1 << int(log2(max(rate / SEEN, 1)))


def _needs_all(level: Level, item: Watched) -> bool:
    """Whether what is watched depends on every step."""
    return isinstance(item.at, ContactEvent) or quantity(item.quantity, level).adds_up


def apart(one: Trace, other: Trace, item: Watched) -> float | None:
    """Return the largest difference of two runs in a quantity, at the times they share [its unit].

    None if an instant came in neither, infinite if in one of them only.
    """
    found, wanted = (samples(trace, item.quantity, item.at) for trace in (one, other))
    if found is None or wanted is None:
        return None if found is wanted else np.inf
    if item.at is not None:
        return _largest(found[1] - wanted[1])
    (t, some), (times, many) = found, wanted
    places = np.searchsorted(times, t * (1 - SAME)).clip(max=len(times) - 1)
    shared = np.abs(times[places] - t) <= SAME * t
    return _largest(some[shared] - many[places[shared]])


def size(trace: Trace, item: Watched) -> float:
    """Return the largest value of what is watched, in its unit."""
    found = samples(trace, item.quantity, item.at)
    return _largest(found[1]) if found else 0.0


def scale(size: float, error: float) -> float:
    """Return what an error is relative to: 1 where nothing is there but the error itself."""
    return size if max(ZERO, error) < size < np.inf else 1.0


def _largest(values: Array) -> float:
    """Return the largest size, infinite if a value is none."""
    worst = float(np.abs(values).max(initial=0.0))
    return worst if np.isfinite(worst) else np.inf
