"""A whole kick: to its step, through the impacts there, and on from it."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct import impacts
from sandbox.physics.contacts.direct.constraint_impulses import hold
from sandbox.physics.contacts.direct.kick_parts import Stage, Taken
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.warm_start import WarmStart
from sandbox.physics.joints.exact.constraints import order


class Beginning(NamedTuple):
    """What a kick begins with; N bodies with the plane.

    Attributes
    ----------
    velocity
        (3 N,), the velocities before it [m/s, rad/s].
    acceleration
        (3 N,), by gravity and force laws in it [m/s², rad/s²].
    change
        (3 N,), what changed in the step before it [m/s, rad/s].
    lead
        How long it lasts until its step [s].
    step
        How long a step is [s].
    strikes
        Whether impacts are looked for.
    driven
        Whether surfaces that run, or kinematic bodies, may give energy.
    """

    velocity: Array
    acceleration: Array
    change: Array
    lead: float
    step: float
    strikes: bool
    driven: bool


def take(kick: Kick, start: Beginning, known: WarmStart, *, placed: bool = False) -> Taken:
    """Return what becomes of a kick, which is as long as its joints say.

    Parameters
    ----------
    kick
        Its rows.
    start
        What it begins with.
    known
        The last one, whose forces it begins with.
    placed
        See `hold`.

    Raises
    ------
    JointFailure, NoForces
        If there are no impulses.
    """
    velocity, acceleration, lead = start.velocity, start.acceleration, start.lead
    at_step, acts = velocity + acceleration * lead, acceleration * start.step
    strikes = impacts.struck(kick, at_step, acts, start.change, looks=start.strikes)
    if not (np.count_nonzero(strikes) or np.count_nonzero(kick.joints.added)):
        return _onwards(kick, start, velocity, kick.joints.kick, known, placed=placed)
    places = order(len(velocity) // 3 - 1)
    came, before = impacts.come(kick, at_step, strikes)
    left, pushes = impacts.bounce(kick, came, strikes)
    rest = _onwards(kick, start, left, kick.joints.kick - lead, known, placed=placed)
    stages = (
        Stage.of(kick, lead, came[places], before),
        Stage.of(kick, 0, left[places], pushes),
        Stage.of(kick, rest.lasts, rest.moved[places], rest.total),
    )
    record, total = impacts.recorded(kick, left, pushes), before + pushes + rest.total
    return rest._replace(total=total, impacts=record, stages=stages)


def _onwards(
    kick: Kick, start: Beginning, begun: Array, lasts: float, known: WarmStart, *, placed: bool
) -> Taken:
    """Return a kick without impacts, or what of it comes after them, so long [s]."""
    motion = begun + start.acceleration * lasts
    guess = known.guess(kick, motion, lasts)
    impulse, moved, active = hold(kick, motion, guess, driven=start.driven, placed=placed)
    return Taken(kick, moved, impulse / lasts, active, impulse, None, (), begun, lasts)
