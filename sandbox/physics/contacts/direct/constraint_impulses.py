"""The impulses with which contacts and joints hold after a drift."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.held_contacts import check_held, without_held
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.linear_systems import nearest
from sandbox.physics.contacts.direct.newton import newton
from sandbox.physics.contacts.direct.row_layout import Layout
from sandbox.physics.joints.exact.constraints import GROWS
from sandbox.physics.state.errors import JointFailure, NoForces

GIVES = 1e-3
"""The share of the kinetic energy that surfaces may give in a kick by pressing on each other: they
give none but for what a step is too long for. Seen are 2e-4 in what is smooth, and 8e-2 where heavy
bodies squeeze out a light one between them."""

Held = tuple[Array, Array, Active]
"""Impulses, (r,), the velocities with them, (3 N,), and which rows hold."""


def hold(
    kick: Kick, motion: Array, guess: tuple[Array, Active], *, driven: bool, placed: bool = False
) -> Held:
    """Return impulses with which all rows hold after the drift, and the velocities then.

    Newton's method starts with the forces of the last step. If it does not converge, or its result
    has energy that nothing gave, then bodies are jammed or squeezed out: the contacts cannot give
    way far enough within one step. In that case velocities are constrained instead of positions,
    which never adds energy.

    Parameters
    ----------
    motion
        (3 N,), the velocities without impulses [m/s, rad/s].
    guess
        The impulses, and which rows hold.
    driven
        Whether surfaces that run, or kinematic bodies, may give energy.
    placed
        Whether velocities are not to be constrained instead of positions.

    Raises
    ------
    JointFailure, NoForces
        If there are none.
    """
    found = without_held(kick)
    if found is None:
        return _found(kick, kick.layout, motion, guess, driven=driven, placed=placed)
    rest, decided = found
    held = _found(kick, rest, motion, guess, driven=driven, placed=placed)
    check_held(kick, decided, held[1])
    return held


def _found(
    kick: Kick,
    layout: Layout,
    motion: Array,
    guess: tuple[Array, Active],
    *,
    driven: bool,
    placed: bool,
) -> Held:
    joints, wanted, (impulse, active) = kick.joints, kick.targets(), guess
    found: Held | None = None
    try:
        found = newton(kick, layout, kick.rows, motion, joints.drift, wanted, impulse, active)
        energy = joints.kinetic(motion)
        grown = _grows(kick, motion, found, energy)
        if not (grown or _squeezes(kick, motion, found, energy)):
            return found
    except (JointFailure, NoForces):
        if placed:
            raise
        grown = True
    none = 0.0 * impulse
    try:
        flat = newton(kick, layout, kick.flat_rows, motion, joints.drift, wanted, none, active)
    except (JointFailure, NoForces):
        if found is None or grown:
            raise
        return found
    held = kick.layout.joints
    if held.stop and not driven:
        work = (flat[0] * (kick.here.jacobian @ (motion + flat[1])))[held]
        joints.refuse_gain(motion, flat[1], work)
    return flat


def _grows(kick: Kick, motion: Array, found: Held, energy: float) -> bool:
    """Return whether energy comes from nowhere: from no winch, belt or kinematic body.

    Without impulses there is so much of it [J].
    """
    impulse, moved, _ = found
    joints, jacobian, layout = kick.joints, kick.here.jacobian, kick.layout
    grown = joints.kinetic(moved) - GROWS * energy
    if grown <= 0:
        return False
    both, free = motion + moved, joints.inverse > 0
    driven = (jacobian != 0) @ (~free & (both != 0))
    driven[layout.joints] |= kick.joint_rates() != 0
    driven[layout.slips] |= kick.runs != 0
    work = impulse[driven] @ (jacobian[driven] @ (both * free)) / 2
    return grown > float(work)


def _squeezes(kick: Kick, motion: Array, found: Held, energy: float) -> bool:
    """Return whether surfaces give energy by pressing on each other; see `_grows`.

    Without the joints a body that is lifted at one end turns, and leaves with its other end what
    presses on that: what surfaces give is seen beside a motion that joints allow.
    """
    impulse, moved, _ = found
    gaps, least = kick.layout.gaps, GIVES * energy
    closing = kick.here.jacobian[gaps]

    def work(before: Array) -> float:
        return float(impulse[gaps] @ (closing @ (before + moved))) / 2

    return work(motion) > least and work(_joined(kick, motion)) > least


def _joined(kick: Kick, motion: Array) -> Array:
    """Return the velocities, (3 N,), that joints alone make of others [m/s, rad/s]."""
    held = np.flatnonzero(kick.layout.problem.free)
    if not len(held):
        return motion
    jacobian, response = kick.here.jacobian[held], kick.response[held]
    rates = jacobian @ motion + kick.joint_rates()[held]
    impulse = nearest(jacobian @ response.T, rates)
    return np.asarray(motion - impulse @ response)
