"""Why exact joints fail: they are redundant, contradict each other, or a step is too long."""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.message import Message
from sandbox.physics.engine.batch import Integers
from sandbox.physics.joints.exact.constraints import Coordinates, Rows
from sandbox.physics.joints.exact.joint_system import JointSystem
from sandbox.physics.joints.exact.solvability import independence, steps_needed
from sandbox.physics.state.errors import JointFailure

SINGULAR = 1e-10
"""The smallest singular value, over the largest, of joints that do not repeat each other."""

LOCKED = 0.1
"""The same, over what it was at the start, of joints that have come to work against each other."""

REACHED = 1e-9
"""m, rad, by which a rope may be too short to count as taut at the start."""


def overlapping(names: Sequence[str], row: int) -> JointFailure:
    """Say that the joint of an equation holds what others hold; (m,), the joints of all."""
    name = names[row]
    reason = Message(
        "'{name}' holds what is held already, or cannot hold it; leave it out", name=name
    )
    if names.count(name) > 1:
        reason = Message("{reason}, or take a rod or a rail, if it is to hold less", reason=reason)
    return JointFailure(name, reason)


def check_independent(joints: JointSystem, here: Rows, response: Array, length: Array) -> float:
    """Refuse joints that repeat each other, as far as they are taut.

    Parameters
    ----------
    joints
        The joints: m equations.
    here
        What they add up to where the bodies are.
    response
        (m, 3 N), M⁻¹ Jᵀ.
    length
        (m,), what they keep [m, rad].

    Returns
    -------
    float
        The smallest singular value over the largest; 1 where nothing is taut.

    Raises
    ------
    JointFailure
        If some do.
    """
    taut = np.flatnonzero(here.total - length > -REACHED)
    if not len(taut):
        return 1.0
    delassus = (here.jacobian @ response.T)[np.ix_(taut, taut)]
    if not delassus.diagonal().all():
        raise overlapping(joints.names, int(taut[np.argmin(delassus.diagonal())]))
    independent, shares = independence(delassus)
    if independent < SINGULAR:
        raise overlapping(joints.names, int(taut[np.flatnonzero(shares > 1e-3)[-1]]))
    return independent


def lost(
    joints: JointSystem, row: int, taut: Integers, independent: float, tension: Array, drift: float
) -> JointFailure:
    """Say why nothing holds an equation: joints work against each other, or the step is long.

    Parameters
    ----------
    joints
        The joints: m equations.
    row
        The equation that is violated most.
    taut
        (k,), the equations that can pull now.
    independent
        The smallest singular value over the largest, at the start.
    tension
        (m,), the forces along the equations in the last kick [N].
    drift
        How long a drift lasts [s].
    """
    place, motion = joints.coordinates()
    jacobian = joints.look(place).jacobian
    delassus = np.asarray(jacobian * joints.inverse @ jacobian.T)[np.ix_(taut, taut)]
    finer = _finer(joints, place, tension, drift)
    if delassus.any() and np.isfinite(delassus).all():
        free, shares = independence(delassus)
        if free < LOCKED * independent:
            name = joints.names[taut[np.argmax(shares)]]
            reason = Message(
                "'{name}' and the joints beside it are stretched: none gives way in a step",
                name=name,
            )
            return JointFailure(name, reason, None if joints.is_driven(motion.values) else finer)
    name = joints.names[row]
    reason = Message("nothing keeps '{name}' as it is through the next step", name=name)
    return JointFailure(name, reason, finer)


def _finer(joints: JointSystem, place: Coordinates, tension: Array, drift: float) -> float:
    """Return how many times as many steps joints under a tension need, at least 2."""

    def force(by: Array) -> Array:
        there = joints.equations.glance(Coordinates(place.values + by))
        return np.asarray(tension @ there.jacobian)

    return steps_needed(force, joints.inverse, drift)
