"""Runs that are held against each other, and what is watched in them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import log2

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Check, ContactEvent, Instant, Level, Stepping
from sandbox.model.quantities import quantity
from sandbox.physics.accuracy.errors import Cancelled
from sandbox.physics.measuring.grading import ZERO, applies, least_scale, samples
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed_at
from sandbox.physics.stepping.making import make_world

Stop = Callable[[], bool]
"""Tells whether somebody has lost patience."""

BLOCK = 50
"""Looks at a run between two questions of that kind."""

SEEN = 240.0
"""Hz, how often a run is looked at, or up to twice that: a look costs more than a step."""

FADING = 0.5
"""The share of itself that is left, at the most, of what fades as the step is halved."""

SAME = 1e-9
"""Times that differ by this share are the same."""


@dataclass(frozen=True, slots=True)
class Watched:
    """A quantity of which the error is estimated, at every step or at an instant.

    Its error is relative to its largest value, or to a scale if that is larger.
    """

    quantity: str
    at: Instant | None = None
    scale: float = 0.0


def watched(level: Level, values: Values) -> tuple[Watched, ...]:
    """Return what the checks that apply measure; if there are none, where bodies are, how fast."""
    checked = (by_check(check, values) for check in level.checks if applies(check, values))
    return tuple(dict.fromkeys(checked)) or tuple(_motion(level))


def by_check(check: Check, values: Values) -> Watched:
    """Return what a check looks at."""
    return Watched(check.quantity, check.at, least_scale(check, values))


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
    seen: float = SEEN,
) -> Trace:
    """Run a level for its duration and record what is watched.

    Parameters
    ----------
    level, values, stepping
        The run.
    wanted
        What is watched.
    stop
        Is asked now and then whether to give up.
    seen
        How often it is looked at, or up to twice that [Hz]; at every step if that is less often, or
        if what is watched depends on every step.

    Raises
    ------
    Cancelled
        If `stop` says so.
    SimulationError
        If the run had to stop.
    """
    world = make_world(level, values, stepping)
    names = dict.fromkeys(name for item in wanted for name in needed_at(item.quantity, item.at))
    recorder = Recorder(world, names)
    all_ = any(_needs_all(level, item) for item in wanted)
    stride = 1 if all_ else _stride(stepping.rate / seen)
    steps = count_steps(world)
    for look, step in enumerate(range(0, steps, stride)):
        if look % BLOCK == 0 and stop():
            raise Cancelled
        world.advance(min(stride, steps - step))
        recorder.note()
    return recorder.trace


def _stride(steps: float) -> int:
    """Return how many of them are taken at a time: a power of two, so that runs share instants."""
    return 1 << int(log2(max(steps, 1)))


def _needs_all(level: Level, item: Watched) -> bool:
    """Whether what is watched depends on every step; books miss none."""
    known = quantity(item.quantity, level)
    return isinstance(item.at, ContactEvent) or known.adds_up or known.booked


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
    """Return what the errors of what is watched are relative to: its largest value, or its scale.

    In its unit; 0 if it has neither.
    """
    found = samples(trace, item.quantity, item.at)
    return max(_largest(found[1]) if found else 0.0, item.scale)


def unit(traces: Sequence[Trace], item: Watched, error: float) -> float:
    """Return what an error of the last of some runs is relative to, each finer than that before.

    Where the value itself fades as the step does, it is nothing but an error of zero: 1.
    """
    before, last = (size(trace, item) for trace in traces[-2:])
    return 1.0 if last < FADING * before else scale(last, error)


def scale(size: float, error: float) -> float:
    """Return what an error is relative to: 1 where nothing is there but the error itself."""
    return size if max(ZERO, error) < size < np.inf else 1.0


def _largest(values: Array) -> float:
    """Return the largest size, infinite if a value is none."""
    worst = float(np.abs(values).max(initial=0.0))
    return worst if np.isfinite(worst) else np.inf
