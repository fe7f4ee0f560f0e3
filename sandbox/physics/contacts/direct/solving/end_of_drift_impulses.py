"""The impulses that satisfy contacts and joints at the end of a drift."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.complementarity.redundant_systems import nearest
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Layout
from sandbox.physics.contacts.direct.solving.newton_method import newton
from sandbox.physics.contacts.direct.solving.redundant_contacts import check_held, without_held
from sandbox.physics.joints.exact.constraint_interface import GROWS
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

GIVES = 1e-3
"""The share of the kinetic energy that normal forces may add in a kick. With short enough steps
they would add none. Measured: 2e-4 in smooth motion, 8e-2 where heavy bodies squeeze out a light
one between them."""


class ConstraintImpulses(NamedTuple):
    """The impulses that satisfy all rows; r of them, N bodies with the plane.

    `velocity`, (3 N,), are the velocities with the impulses, (r,) [m/s, rad/s], and `active` the
    active rows. `flat` tells whether contacts constrain velocities instead of positions.
    """

    impulse: Array
    velocity: Array
    active: Active
    flat: bool = False


def hold(
    kick: Kick, motion: Array, guess: tuple[Array, Active], *, driven: bool, placed: bool = False
) -> ConstraintImpulses:
    """Return impulses that satisfy all rows at the end of the drift, and the velocities with them.

    Newton's method starts with the forces of the last step. If it does not converge, or if its
    result gains energy from nowhere, bodies are jammed or squeezed out: contacts cannot yield far
    enough within one step. Then velocities are constrained instead of positions, which never adds
    energy.

    `motion`, (3 N,), are the velocities without impulses [m/s, rad/s], and `guess` has the impulses
    and the active rows to begin with. `driven` tells whether running surfaces or kinematic bodies
    may add energy; `placed`, whether positions must be constrained: velocities will not do. Raises
    `JointFailure` or `NoForces` if no impulses are found.
    """
    found = without_held(kick)
    if found is None:
        return _found(kick, kick.layout, motion, guess, driven=driven, placed=placed)
    rest, decided = found
    solution = _found(kick, rest, motion, guess, driven=driven, placed=placed)
    check_held(kick, decided, solution.velocity)
    return solution


def _found(
    kick: Kick,
    layout: Layout,
    motion: Array,
    guess: tuple[Array, Active],
    *,
    driven: bool,
    placed: bool,
) -> ConstraintImpulses:
    joints, wanted, (impulse, active) = kick.joints, kick.targets(), guess
    found: ConstraintImpulses | None = None
    try:
        args = motion, joints.drift, wanted, impulse, active
        found = ConstraintImpulses(*newton(kick, layout, kick.rows, *args))
        energy = joints.kinetic_energy(motion)
        grown = _grows(kick, motion, found, energy)
        if not (grown or _squeezes(kick, motion, found, energy)):
            return found
    except (JointFailure, NoForces):
        if placed:
            raise
        grown = True
    none = 0.0 * impulse
    try:
        args = motion, joints.drift, wanted, none, active
        flat = ConstraintImpulses(*newton(kick, layout, kick.flat_rows, *args), flat=True)
    except (JointFailure, NoForces):
        if found is None or grown:
            raise
        return found
    joint_rows = kick.layout.joints
    if joint_rows.stop and not driven:
        work = (flat.impulse * (kick.rows_at_start.jacobian @ (motion + flat.velocity)))[joint_rows]
        joints.refuse_gain(motion, flat.velocity, work)
    return flat


def _grows(kick: Kick, motion: Array, found: ConstraintImpulses, energy: float) -> bool:
    """Return whether energy comes from nowhere: from no winch, belt or kinematic body.

    `energy` is the kinetic energy without impulses [J].
    """
    impulse, velocity, *_ = found
    joints, jacobian, layout = kick.joints, kick.rows_at_start.jacobian, kick.layout
    grown = joints.kinetic_energy(velocity) - GROWS * energy
    if grown <= 0:
        return False
    both, free = motion + velocity, joints.inverse > 0
    driven_rows = (jacobian != 0) @ (~free & (both != 0))
    driven_rows[layout.joints] |= kick.joint_rates() != 0
    driven_rows[layout.slips] |= kick.belt_slip != 0
    work = impulse[driven_rows] @ (jacobian[driven_rows] @ (both * free)) / 2
    return grown > float(work)


def _squeezes(kick: Kick, motion: Array, found: ConstraintImpulses, energy: float) -> bool:
    """Return whether normal forces add energy; see `_grows`.

    Their work is compared with the free motion, and with the motion that the joints allow: without
    its joints a body that is lifted at one end would turn, and its other end would come free.
    """
    impulse, velocity, *_ = found
    gaps, least = kick.layout.gaps, GIVES * energy
    closing, pushes = kick.rows_at_start.jacobian[gaps], impulse[gaps]

    def work(before: Array) -> float:
        return float(pushes.dot(closing.dot(before + velocity))) / 2

    return work(motion) > least and work(_joined(kick, motion)) > least


def _joined(kick: Kick, motion: Array) -> Array:
    """Return velocities, (3 N,), after the impulses of the joints alone [m/s, rad/s]."""
    free_rows = np.flatnonzero(kick.layout.problem.free)
    if not len(free_rows):
        return motion
    jacobian, response = kick.rows_at_start.jacobian[free_rows], kick.response[free_rows]
    rates = jacobian @ motion + kick.joint_rates()[free_rows]
    impulse = nearest(jacobian @ response.T, rates)
    return np.asarray(motion - impulse @ response)
