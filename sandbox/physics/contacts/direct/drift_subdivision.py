"""A drift in parts, for when no impulses can hold contacts and joints through all of it.

A heavy wheel on a chain of light planks whips them straight. No impulses then keep their lengths
until the end of the drift: the equations of the step have no solution, by whatever method. For a
shorter drift they have one. So this one drift is divided into equal parts, as few as suffice, with
a kick between any two. In these kicks forces act as they did in the last one; contacts and joints
stay as they are. pymunk receives the velocities of a straight drift to the end of the last part.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_impulses import hold
from sandbox.physics.contacts.direct.kick_parts import Taken
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.joints.exact.constraints import Coordinates
from sandbox.physics.state.errors import JointFailure, NoForces

PARTS = (2, 4, 8, 16, 32)
"""In how many parts a drift is taken: in the first of these that serves."""


class Divided(NamedTuple):
    """A drift in parts, as others see it; n bodies.

    Attributes
    ----------
    parts
        How many.
    left
        (n, 3), the velocities that the kick before it would have ended with, had it been whole
        [m/s, rad/s].
    begun
        (n, 3), those that a whole kick after it begins with [m/s, rad/s].
    """

    parts: int
    left: Array
    begun: Array


class Through(NamedTuple):
    """A way through a drift; r rows, N bodies with the plane.

    Attributes
    ----------
    parts
        In how many.
    first
        The kick before it, with the impulses that it would have given in its whole length.
    left, begun
        (3 N,), see `Divided`.
    way
        (3 N,), how far everything gets [m, rad].
    """

    parts: int
    first: Taken
    left: Array
    begun: Array
    way: Array


def through(
    kick: Kick, acceleration: Array, until: float, take: Callable[[Kick], Taken]
) -> Through:
    """Return a way through the drift after a kick of a step.

    Parameters
    ----------
    kick
        For which there are no impulses.
    acceleration
        (3 N,), by gravity and force laws [m/s², rad/s²].
    until
        The time at the end of the drift [s].
    take
        Returns what becomes of a kick, which is as long as its joints say.

    Raises
    ------
    JointFailure, NoForces
        If there is none in any number of parts.
    """
    joints, whole = kick.joints, kick.joints.drift
    lost: JointFailure | NoForces | None = None
    for parts in PARTS:
        times = until - whole + whole * np.arange(parts + 1) / parts
        lengths = [joints.lengths(float(t)) for t in times]
        try:
            return _in_parts(kick, acceleration, lengths, take)
        except (JointFailure, NoForces) as error:
            lost = error
        finally:
            joints.time(whole, whole)
    assert lost
    raise lost


def _in_parts(
    kick: Kick, acceleration: Array, lengths: list[Array], take: Callable[[Kick], Taken]
) -> Through:
    """Return the way, with what the joints keep at the ends of its parts: (m,) each [m, rad]."""
    joints, whole, parts = kick.joints, kick.joints.drift, len(lengths) - 1
    drift = whole / parts
    missing = (whole - drift) / 2  # of the length of the kicks before and after
    joints.time(whole - missing, drift)
    first = take(kick.between(kick.place, lengths[0], lengths[1]))
    moved, forces, active = first.moved, first.forces, first.active
    joints.time(drift, drift)
    place = Coordinates(kick.place.values + drift * moved)
    for before, after in pairwise(lengths[1:]):
        now = kick.between(place, before, after)
        motion = moved + drift * acceleration
        impulse, moved, active = hold(now, motion, (drift * forces, active), driven=False)
        forces = impulse / drift
        place = Coordinates(place.values + drift * moved)
    return Through(
        parts,
        first._replace(total=first.total + missing * first.forces),
        first.moved + missing * (acceleration + first.forces.dot(first.kick.response)),
        moved - missing * acceleration,
        place.values - kick.place.values,
    )
