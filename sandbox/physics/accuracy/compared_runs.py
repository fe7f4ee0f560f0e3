"""Runs that are compared with each other, and the quantities that are compared."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import log2

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Check, ContactEvent, Instant, Level, SeparationEvent, Stepping
from sandbox.model.number_bounds import Duration
from sandbox.model.quantities import quantity
from sandbox.physics.accuracy.exceptions import Cancelled
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.measuring.grading import ZERO, applies, least_scale, samples
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed_at
from sandbox.physics.stepping.make_world import make_world

Stop = Callable[[], bool]
"""A callback that returns whether to give up."""

BLOCK = 50
"""The number of observations of a run between two calls of `Stop`."""

SEEN = 240.0
"""The rate of observations, up to twice this [Hz]: an observation costs more than a step."""

FADING = 0.5
"""The largest ratio of successive errors, as the step is halved, for an error that vanishes."""

ROUNDING = 1e-12
"""The smallest change that counts as a jump, as a share of the largest value."""

SAME = 1e-9
"""Times that differ by less than this share are the same."""

LITTLE = 1e-2
"""Small coordinates or velocities are compared relative to this share of the scene's largest."""

JUMPS = 5.0
"""The least ratio of a jump to the changes around it."""


RATES = {
    "position.x": ("velocity.x", "acceleration.x"),
    "position.y": ("velocity.y", "acceleration.y"),
    "angle": ("angular_velocity", "angular_acceleration"),
}
"""The first and the second derivative of each coordinate."""


@dataclass(frozen=True, slots=True)
class Watched:
    """A quantity whose error is estimated, at every step or at an instant.

    Its error is relative to its largest value, or to a scale if that is larger.
    """

    quantity: str
    at: Instant | None = None
    """Its instant; None for every step."""
    scale: float = 0.0
    """The least scale of its error."""
    motion: bool = False
    """Whether it is watched as part of its body's motion. Such a velocity is not compared where it
    jumps, as in an impact: the positions show how late it jumps."""

    @property
    def rates(self) -> tuple[str, str] | None:
        """The first and second derivative of a coordinate; None for any other quantity."""
        subject, _, rest = self.quantity.partition(".")
        if self.at is not None or rest not in RATES:
            return None
        first, second = RATES[rest]
        return f"{subject}.{first}", f"{subject}.{second}"


def watched(level: Level, values: Values, also: Iterable[str] = ()) -> tuple[Watched, ...]:
    """Return the quantities of the checks that apply, the additional ones, and all motion."""
    named = tuple(dict.fromkeys((*checked(level, values), *(Watched(name) for name in also))))
    throughout = {item.quantity for item in named if item.at is None}
    return (*named, *(item for item in motion(level) if item.quantity not in throughout))


def checked(level: Level, values: Values) -> tuple[Watched, ...]:
    """Return the quantities of the checks that apply."""
    found = (check_item(check, values) for check in level.checks if applies(check, values))
    return tuple(dict.fromkeys(found))


def scaled(items: Sequence[Watched], trace: Trace) -> tuple[Watched, ...]:
    """Return the watched quantities with scales, leaving out motion that does not occur in a run.

    A coordinate that stays small is compared relative to a share of the scene's largest one.
    """
    largest: dict[str, float] = {}
    for item in items:
        if item.motion:
            kind = _kind(item)
            largest[kind] = max(largest.get(kind, 0.0), _largest(trace.columns[item.quantity]))
    return tuple(
        replace(item, scale=LITTLE * largest[_kind(item)]) if item.motion else item
        for item in items
        if not item.motion or np.ptp(trace.columns[item.quantity]) > 0
    )


def _kind(item: Watched) -> str:
    """Return the kind of motion: position, velocity, angle or angular_velocity."""
    *_, component_of, last = item.quantity.rsplit(".", 2)
    return component_of if last in ("x", "y") else last


def check_item(check: Check, values: Values) -> Watched:
    """Return the quantity of a check."""
    return Watched(check.quantity, check.at, least_scale(check, values))


def motion(level: Level) -> Iterator[Watched]:
    """Yield the positions and velocities of the dynamic bodies."""
    parts = ["position.x", "position.y", "velocity.x", "velocity.y"]
    parts += ["angle", "angular_velocity"] if level.effects.rotation else []
    for name, body in level.bodies.items():
        if body.type == "dynamic":
            yield from (Watched(f"{name}.{part}", motion=True) for part in parts)


def at_least_lasting(level: Level, values: Values, duration: float | None) -> Level:
    """Return a level with at least a given duration [s]."""
    if duration is None or duration <= level.duration(values):
        return level
    return level.model_copy(update={"duration": Duration(duration)})


def never() -> bool:
    """Return False: never give up."""
    return False


def record(
    level: Level,
    values: Values,
    stepping: Stepping,
    items: Sequence[Watched],
    stop: Stop = never,
    observation_rate: float = SEEN,
    inspect: Callable[[Recorder], None] | None = None,
) -> Trace:
    """Run a level for its duration and record the watched quantities.

    `observation_rate` is the rate of observations, or up to twice that [Hz]; every step is observed
    if the run is slower than that, or if a watched quantity depends on every step. `inspect` is
    called now and then. Raises `Cancelled` if `stop` returned true, and `SimulationError` if the
    run had to stop.
    """
    world = make_world(level, values, stepping)
    names = dict.fromkeys(name for item in items for name in _recorded_names(item))
    recorder = Recorder(world, names)
    every_step = any(_needs_every_step(level, item) for item in items)
    steps = 1 if every_step else stride(stepping.rate, observation_rate)
    for index in range(-(-count_steps(world) // steps)):  # rounded up, to reach the end
        if index % BLOCK == 0 and stop():
            raise Cancelled
        if inspect and index and index % BLOCK == 0:
            inspect(recorder)
        world.advance(steps)  # instants need samples at equal intervals
        recorder.note()
    return recorder.trace


def record_around(
    level: Level,
    values: Values,
    stepping: Stepping,
    items: Sequence[Watched],
    times: Iterable[float],
    stop: Stop = never,
    parts: int = 1,
) -> Trace:
    """Run a level and record quantities at each step, or each few `parts`, around some times [s].

    For the other parameters and the errors see `record`.
    """
    world = make_world(level, values, stepping)
    recorder = Recorder(
        world, dict.fromkeys(name for item in items for name in _recorded_names(item))
    )
    rate, count, done = stepping.rate / parts, count_steps(world) // parts, 0
    spans = (np.array([time - 2 / SEEN, time + 2 / SEEN]) * rate for time in times)
    near = {
        n for first, last in spans for n in range(max(int(first), 1), min(int(last), count) + 1)
    }
    for step in sorted(near):
        if stop():
            raise Cancelled
        world.advance((step - done) * parts)
        recorder.note()
        done = step
    return recorder.trace


def _recorded_names(item: Watched) -> Iterator[str]:
    """Yield the quantities to record: the quantity itself, and a coordinate's derivatives."""
    yield from needed_at(item.quantity, item.at)
    yield from item.rates or ()


def stride(rate: float, observation_rate: float = SEEN) -> int:
    """Return the number of steps between observations, given both rates [Hz].

    It is a power of two, so that runs share instants.
    """
    return 1 << int(log2(max(rate / observation_rate, 1)))


def _needs_every_step(level: Level, item: Watched) -> bool:
    """Whether a quantity depends on every step."""
    known = quantity(item.quantity, level)
    return isinstance(item.at, ContactEvent | SeparationEvent) or not known.is_momentary


def largest_difference(one: Trace, other: Trace, item: Watched) -> float | None:
    """Return the largest difference of a quantity between two runs, at shared times [its unit].

    None if the instant occurs in neither run, infinite if it occurs in only one.
    """
    found, items = (samples(trace, item.quantity, item.at) for trace in (one, other))
    if found is None or items is None:
        return None if found is items else np.inf
    if item.at is not None:
        return _largest(found[1] - items[1])
    (t, values), (times, other_values) = found, items
    shared, indices = shared_times(t, times)
    difference = values[shared] - other_values[indices]
    if item.motion and "velocity" in _kind(item) and len(difference):
        difference[_near_jumps((t, values), (times, other_values), t[shared])] = 0.0
    return _largest(difference)


def departure(one: Trace, other: Trace, item: Watched, error: float) -> float | None:
    """Return until when two runs agree on a coordinate, to a relative error [s].

    None if they agree to the end, or if the quantity is a velocity or has an instant.
    """
    if item.at is not None or (item.motion and "velocity" in _kind(item)):
        return None
    (t, values), (times, other_values) = ((r.t, r.columns[item.quantity]) for r in (one, other))
    shared, indices = shared_times(t, times)
    reference = error_scale(item_scale(other, item), 0.0)
    differing = np.flatnonzero(
        ~(np.abs(values[shared] - other_values[indices]) <= error * reference)
    )
    return float(t[shared][max(differing[0] - 1, 0)]) if len(differing) else None


def shared_times(t: Array, times: Array) -> tuple[Integers, Integers]:
    """Return the indices of times that are among others, and their indices there."""
    indices = np.searchsorted(times, t * (1 - SAME)).clip(max=len(times) - 1)
    shared = np.flatnonzero(np.abs(times[indices] - t) <= SAME * t)
    return shared, indices[shared]


def _near_jumps(one: tuple[Array, Array], other: tuple[Array, Array], at: Array) -> Integers:
    """Return the indices of times near a jump in either of two runs, each (times, values)."""
    times = np.concatenate([_jumps(*run) for run in (one, other)])
    if not len(times):
        return np.empty(0, dtype=np.intp)
    interval = max(_usual_interval(t) for t, _ in (one, other))
    near = np.abs(at[:, None] - times).min(axis=1)
    return np.flatnonzero(near <= interval * (1 + SAME))


def _usual_interval(t: Array) -> float:
    """Return the time between two observations, whatever lies between parts of a run; 0 if one."""
    return float(np.median(np.diff(t))) if len(t) > 1 else 0.0


def _jumps(t: Array, values: Array) -> Array:
    """Return the times at which values jump."""
    sharp = jumps(values)
    return (t[:-1][sharp] + t[1:][sharp]) / 2


def jumps(values: Array) -> Array:
    """Return the intervals in which values jump permanently, (T - 1,), unlike around them."""
    change = np.abs(np.diff(values))
    padded = np.concatenate(([0.0, 0.0], change, [0.0, 0.0]))
    around = np.maximum(padded[:-4], padded[4:])
    over_two = np.abs(values[2:] - values[:-2])  # a spike is not a jump
    lasting = np.minimum(np.append(over_two, np.inf), np.append(np.inf, over_two))
    sharp = (change > JUMPS * around) & (lasting > change / 2)
    return np.asarray(sharp & (change > ROUNDING * np.abs(values).max(initial=0.0)))


def item_scale(trace: Trace, item: Watched) -> float:
    """Return the scale of a quantity's errors in its unit: its largest value, or a given scale.

    0 if it has neither.
    """
    found = samples(trace, item.quantity, item.at)
    return max(_largest(found[1]) if found else 0.0, item.scale)


def error_unit(traces: Sequence[Trace], item: Watched, error: float) -> float:
    """Return the scale of the last run's error; each of the runs is finer than the one before.

    1 if the value itself vanishes with the step: then zero is expected, and the error is absolute.
    """
    before, last = (item_scale(trace, item) for trace in traces[-2:])
    return 1.0 if last < FADING * before else error_scale(last, error)


def error_scale(size: float, error: float) -> float:
    """Return the scale of an error: the quantity's size, or 1 if that is not above the error."""
    return size if max(ZERO, error) < size < np.inf else 1.0


def _largest(values: Array) -> float:
    """Return the largest absolute value; infinite if a value is not finite."""
    worst = float(np.abs(values).max(initial=0.0))
    return worst if np.isfinite(worst) else np.inf
