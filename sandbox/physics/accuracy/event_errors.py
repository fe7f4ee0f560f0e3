"""Errors from sudden events between two steps: impacts, and forces that set in or end.

An impact that is not located is found at a step, up to one step late. A run with half the step may
find it at the same instant. Then both are wrong by the same amount, and their difference does not
show it; every other time a third run, with half of that step, agrees with them. So an instant is
known to a step of the finest run, however well the runs agree.

Where a force sets in or ends, the velocity that is read at that one step is the mean of two between
which it changed.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.accuracy.compared_runs import Watched, jumps, scale, size
from sandbox.physics.measuring.recording import Trace

BY_CHANCE = 0.1
"""The share by which a force may do more between two observations without an event."""

ROUNDING = 1e-12
"""Changes below this share of the largest velocity are no jumps."""


class Off(NamedTuple):
    """How far off something may be, relative, and what; None if nothing is."""

    error: float = 0.0
    item: Watched | None = None


def lateness(trace: Trace, wanted: Sequence[Watched]) -> Off:
    """Return how far off a run may be for what it finds a step too late.

    A body that an impact turns back a step too late is off by what that changes of its velocity,
    times the step. Impacts that are located are not late, and where nothing touches there are none.
    """
    late = _found_late(trace, wanted)
    return _worst(trace, ((item, float(motion.jumps.max(initial=0.0))) for item, motion in late))


def timely(trace: Trace, wanted: Sequence[Watched], error: float) -> float:
    """Return until when nothing is found so late that a run is off by more than an error [s]."""
    until, step = float(trace.t[-1]), 1 / trace.stepping.rate
    for item, motion in _found_late(trace, wanted):
        late = motion.jumps * step > error * scale(size(trace, item), 0.0)
        until = min(until, float(trace.t[:-1][late].min(initial=until)))
    return until


def onset(trace: Trace, wanted: Sequence[Watched], rate: float) -> Off:
    """Return how far off a velocity may be at a step in which a force sets in or ends.

    That is half of a step of the change, at a rate [Hz], as it is seen in a finer run.
    """
    velocities = {item.quantity: item for item in wanted if item.at is None}
    found = _motions(trace, wanted)
    named = ((velocities.get(item.rates[0]), motion) for item, motion in found if item.rates)
    changes = ((item, motion.change / 2) for item, motion in named if item)
    return _worst(trace, changes, rate)


def _found_late(trace: Trace, wanted: Sequence[Watched]) -> Iterator[tuple[Watched, "_Motion"]]:
    """Yield the coordinates of bodies that may have impacts which are not located in time.

    A joint that goes taut is none: it holds at the end of the step in which it does.
    """
    if contact := trace.level.effects.contact:
        exact = contact.located or ()
        yield from _motions(trace, [i for i in wanted if i.quantity.partition(".")[0] not in exact])


def _worst(trace: Trace, found: Iterator[tuple[Watched, float]], rate: float = 0.0) -> Off:
    """Return what is furthest off, of changes a second, in a step of a run or of another rate."""
    step, worst = 1 / (rate or trace.stepping.rate), Off()
    for item, change in found:
        off = change * step
        worst = max(worst, Off(off / scale(size(trace, item), off), item), key=lambda o: o.error)
    return worst


class _Motion(NamedTuple):
    """The motion of a coordinate, sampled now and then: (T,) each."""

    t: Array
    velocity: Array
    acceleration: Array

    @property
    def jumps(self) -> Array:
        """By how much the velocity changes at once, from look to look."""
        return np.where(self._at_once, self._beyond, 0.0)

    @property
    def change(self) -> float:
        """By how much the acceleration does, where the velocity does not."""
        sharp = np.logical_and(jumps(self.acceleration), np.logical_not(self._at_once))
        return float(np.abs(np.diff(self.acceleration))[sharp].max(initial=0.0))

    @property
    def _pushed(self) -> Array:
        """By how much forces change the velocity from look to look."""
        return (self.acceleration[1:] + self.acceleration[:-1]) / 2 * np.diff(self.t)

    @property
    def _beyond(self) -> Array:
        """By how much it changes beyond that."""
        return np.abs(np.diff(self.velocity) - self._pushed)

    @property
    def _at_once(self) -> Array:
        """Between which looks that is more than forces can do that change between them."""
        changing = np.abs(np.diff(self.acceleration)) / 2 * np.diff(self.t)
        rounding = ROUNDING * np.abs(self.velocity).max(initial=0.0)
        return self._beyond > changing + BY_CHANCE * np.abs(self._pushed) + rounding


def _motions(trace: Trace, wanted: Sequence[Watched]) -> Iterator[tuple[Watched, _Motion]]:
    """Yield the coordinates that are watched, and how they change."""
    for item in wanted:
        if item.rates:
            yield item, _Motion(trace.t, *(trace.columns[name] for name in item.rates))
