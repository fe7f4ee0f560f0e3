"""Errors from what lies between two steps: impacts, forces that set in or end, and peaks.

An impact that is not located is found at a step, up to one step late. A run with half the step may
find it at the same instant: both are wrong by the same amount, and their difference does not show
it. Half of the time a third run, with half of that step, agrees with them as well. The time of such
an impact is therefore known to one step of the finest run, however well the runs agree.

At the step in which a force sets in or ends, the recorded velocity is the mean of two velocities
between which it changed.

A running extreme misses what lies between two steps. Two runs agree on it wherever the highest of
their steps is the same one.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.accuracy.compared_runs import Watched, error_scale, item_scale, jumps
from sandbox.physics.measuring.recording import Trace

BY_CHANCE = 0.1
"""The tolerance for changes by forces between two observations without an event, as a share."""

ROUNDING = 1e-12
"""The smallest change that counts as a jump, as a share of the largest velocity."""


EXTREMES = ("min", "max", "largest", "amplitude")
"""The aggregates that are extremes."""


class RelativeError(NamedTuple):
    """A relative error and its quantity; None if there is no error."""

    error: float = 0.0
    item: Watched | None = None


def hidden_error(trace: Trace, watched_items: Sequence[Watched]) -> RelativeError:
    """Return the largest error of a run that its difference from a finer run may not show.

    A body whose impact is found one step late is displaced by the change of its velocity times the
    step. Located impacts are not late, and a level without contacts has none. An extreme may be
    missed by an eighth of the second difference there.
    """
    step = 1 / trace.stepping.rate
    late = (
        (item, step * float(motion.jumps.max(initial=0.0)))
        for item, motion in _found_late(trace, watched_items)
    )
    extremes = (item for item in watched_items if item.quantity.rpartition(".")[2] in EXTREMES)
    missed = ((item, _missed(trace.columns[item.quantity])) for item in extremes)
    errors = (
        RelativeError(difference / error_scale(item_scale(trace, item), difference), item)
        for item, difference in (*late, *missed)
    )
    return max(errors, key=lambda found: found.error, default=RelativeError())


def _missed(extreme: Array) -> float:
    """Return by how much a running extreme may be off where it slows down to a peak."""
    slope = np.abs(np.diff(extreme))
    earlier, last, after = slope[:-2], slope[1:-1], slope[2:]
    peak = (after == 0) & (last > 0) & (last < earlier)
    return float((earlier - last)[peak].max(initial=0.0)) / 8


def time_without_late_impact(trace: Trace, watched_items: Sequence[Watched], error: float) -> float:
    """Return until when no impact is found late enough to cause more than a given error [s]."""
    end, step = float(trace.t[-1]), 1 / trace.stepping.rate
    for item, motion in _found_late(trace, watched_items):
        late = motion.jumps * step > error * error_scale(item_scale(trace, item), 0.0)
        end = min(end, float(trace.t[:-1][late].min(initial=end)))
    return end


class Onsets(NamedTuple):
    """When forces set in or end."""

    times: Sequence[float]
    """the times [s]"""
    items: Sequence[Watched]
    """the velocities that change there, with their largest values of the whole run as scales"""
    rate: float = 0.0
    """the rate from which they are certainly known well enough at each step [Hz]"""


def onsets(trace: Trace, watched_items: Sequence[Watched], rate: float, error: float) -> Onsets:
    """Return when forces set in or end so that a velocity may be off by more than an error.

    At a rate [Hz] it may be off by half of the change of the acceleration, which is seen in a finer
    run, times a step.
    """
    known = {item.quantity: item for item in velocities(trace, watched_items)}
    times, items, needed = set[float](), [], 0.0
    for coordinate, motion in _motions(trace, watched_items):
        item = known.get(coordinate.rates[0]) if coordinate.rates else None
        if item is None:
            continue
        rates = motion.changes / 2 / (error * error_scale(item.scale, 0.0))
        found = np.flatnonzero(rates > rate)
        if len(found):
            times.update(((motion.t[:-1] + motion.t[1:]) / 2)[found].tolist())
            items.append(item)
            needed = max(needed, float(rates.max()))
    return Onsets(sorted(times), items, needed)


def velocities(trace: Trace, watched_items: Sequence[Watched]) -> list[Watched]:
    """Return the velocities that are watched, with their largest values in a run as scales."""
    found = [item for item in watched_items if item.at is None and "velocity" in item.quantity]
    return [replace(item, scale=item_scale(trace, item)) for item in found]


def _found_late(
    trace: Trace, watched_items: Sequence[Watched]
) -> Iterator[tuple[Watched, "_Motion"]]:
    """Yield the coordinates of bodies whose impacts are not located in time.

    A joint that becomes taut is not an impact: it holds at the end of the same step.
    """
    if contact := trace.level.effects.contact:
        exact = contact.located or ()
        yield from _motions(
            trace, [i for i in watched_items if i.quantity.partition(".")[0] not in exact]
        )


class _Motion(NamedTuple):
    """The motion of a coordinate at the observations: (T,) each."""

    t: Array
    velocity: Array
    acceleration: Array

    @property
    def jumps(self) -> Array:
        """The sudden changes of the velocity between observations."""
        return np.where(self._is_sudden, self._unexplained, 0.0)

    @property
    def changes(self) -> Array:
        """The jumps of the acceleration between observations where the velocity does not jump."""
        sharp = np.logical_and(jumps(self.acceleration), np.logical_not(self._is_sudden))
        return np.where(sharp, np.abs(np.diff(self.acceleration)), 0.0)

    @property
    def _by_forces(self) -> Array:
        """The change of the velocity by forces between observations."""
        return (self.acceleration[1:] + self.acceleration[:-1]) / 2 * np.diff(self.t)

    @property
    def _unexplained(self) -> Array:
        """The change of the velocity that forces do not explain."""
        return np.abs(np.diff(self.velocity) - self._by_forces)

    @property
    def _is_sudden(self) -> Array:
        """The intervals in which that change exceeds what varying forces can cause."""
        changing = np.abs(np.diff(self.acceleration)) / 2 * np.diff(self.t)
        rounding = ROUNDING * np.abs(self.velocity).max(initial=0.0)
        return self._unexplained > changing + BY_CHANCE * np.abs(self._by_forces) + rounding


def _motions(trace: Trace, watched_items: Sequence[Watched]) -> Iterator[tuple[Watched, _Motion]]:
    """Yield the coordinates that are watched, with their motion."""
    for item in watched_items:
        if item.rates:
            yield item, _Motion(trace.t, *(trace.columns[name] for name in item.rates))
