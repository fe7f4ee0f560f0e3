"""Friction that ends a slip within a drift, and when.

Until a slip ends, friction is at its bound; from there on it holds if it can. With sliding or
static friction for the whole kick, a body would stop up to half a step too early or too late.
"""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.geometry.root_finding import SecantMethod
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

LEAST = 1e-8
"""m: the end of a slip is located only if the slip would be longer in the drift."""

FEW = 6
"""No ends are located among more rows of friction that affect each other: in larger heaps slips end
all the time, and chance decides where a body comes to rest."""

SURE = 1e-9
"""The time of an end, and the one for which the kick is solved, must agree within this share of a
drift."""

SOON = 1e-3
"""In this first share of a drift, no end of a slip is located."""

TINY = 1e-12
"""A slip that slows down by less than this share in a drift counts as slowing by so much."""

TRIES = 8
"""The most lengths of a drift that are tried."""


def slip_ends(part: Subdrift, laws: Array) -> Integers:
    """Return which friction ends a slip within a part of a drift: indices among all friction.

    `laws`, (3 N,), are the accelerations by gravity and force laws [m/s², rad/s²].
    """
    bears = _bears(part)
    if not np.count_nonzero(bears):
        return np.zeros(0, dtype=np.intp)
    rows = np.flatnonzero(bears)
    first, last = _rates(part, laws, rows)
    ends = rows[(first * last < 0) & (np.abs(first) * part.drift > LEAST)]
    few = [one.slips for one in part.kick.layout.islands if len(one.slips) <= FEW and len(ends)]
    return ends[np.isin(ends, np.concatenate(few))] if few else ends[:0]


def until_it_stops(
    part: Subdrift,
    ends: Integers,
    laws: Array,
    shortened: Callable[[Subdrift, float, Subdrift], Subdrift],
) -> Subdrift | None:
    """Return a part of a drift up to where the first of some slips ends; None if none does.

    `part` comes with the kick before it, and `ends` is the friction that may end a slip; for this
    and `laws` see `slip_ends`. `shortened` returns the part with a shorter drift [s], with a
    similar part to begin with.
    """
    shorter, time, times = part, part.drift, SecantMethod(part.drift)
    ends = _beside(part, ends)
    for _ in range(TRIES):
        slips = ends[shorter.active.slip[ends] != 0]
        if len(slips):
            again = _ends(shorter, laws, slips)
            if abs(again - time) <= SURE * part.drift:
                return None if shorter is part else shorter
            time = times.following(time, again)
        elif shorter is part:  # it sticks all the time: does it slip at first?
            time = SOON * part.drift
        else:
            break
        if not SOON * part.drift <= time < part.drift:
            break
        try:
            shorter = shortened(part, time, shorter)
        except (JointFailure, NoForces):
            break
    return None


def _beside(part: Subdrift, ends: Integers) -> Integers:
    """Return all friction between the bodies of some.

    Where two lines meet, a disc touches both at one point. Either may bear it and its friction.
    """
    bodies = np.sort(part.kick.layout.touching.friction_bodies, axis=0)
    same = (bodies[:, :, None] == bodies[:, None, ends]).all(axis=0)
    return np.flatnonzero(same.any(axis=1))


def _ends(part: Subdrift, laws: Array, slips: Integers) -> float:
    """Return when the first of some slips ends on the parabolas of a part, or beyond its end."""
    first, last = _rates(part, laws, slips)
    slows = (first - last) / first
    return part.drift / max(float(slows.max()), TINY)


def _bears(part: Subdrift) -> Booleans:
    """Return which friction slips, or may have ended a slip in the kick: (f,).

    It may be of any size: where a slip is reversed, friction has either sign within one kick.
    """
    friction = part.kick.layout.problem.friction
    bound = friction.kinetic * (friction.has_contact * part.forces[friction.contact]).sum(axis=0)
    return np.asarray(bound > 0)


def _rates(part: Subdrift, laws: Array, rows: Integers) -> Array:
    """Return the rates of slips at the beginning and at the end of a part: (2, s) [m/s]."""
    kick, half = part.kick, (laws + part.constraint_acceleration) * (part.drift / 2)
    jacobian = kick.rows_at_start.jacobian[kick.layout.slips][rows]
    rates: Array = (
        np.array((part.velocity - half, part.velocity + half)) @ jacobian.T + kick.belt_slip[rows]
    )
    return rates
