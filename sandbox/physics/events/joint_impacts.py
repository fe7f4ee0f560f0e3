"""Impacts of joints at one instant: a joint catches, or a body runs into an elastic stop.

All joints and contacts take part: the impulses λ along the rows of the Jacobian J are solved
together, so that afterwards no constraint is violated any further, and bodies that bounce separate
by Newton's law of restitution,

    v' = v + M⁻¹ Jᵀ λ,    J v' = −e J v,

with λ >= 0 for one-sided constraints. A joint that catches has e = 0: it is a perfectly inelastic
impact of the bodies that it ties, and takes the energy of their relative motion.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kicks.coupled_impacts import impulses
from sandbox.physics.contacts.direct.rows.contact_outlines import Figures
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces, lay_out
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Contacts
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.joint_forces import JointForces
from sandbox.physics.scene.make_scene import Scene


class Jolt(NamedTuple):
    """The outcome of an impact of joints; n bodies, m equations."""

    t: float
    """The time of the impact [s]."""
    pose: Array
    """(n, 3), the positions [m, rad]."""
    velocity_before: Array
    """(n, 3), the velocities before it [m/s, rad/s]."""
    velocity_after: Array
    """(n, 3), the velocities after it [m/s, rad/s]."""
    joint_impulses: JointForces
    """The impulses of the exact joints, in place of tensions [N s]."""
    contacts: Contacts
    """The contacts, with their impulses."""
    elastic: bool
    """Whether it takes no energy: only stops with e = 1 take part."""


def jolt(scene: Scene, t: float, bounces: Mapping[int, float] | None = None) -> Jolt:
    """Solve an impact of all joints at a time [s]; the scene has the velocities before it.

    `bounces` are the coefficients of restitution of the equations that bounce, by row. Raises
    `JointFailure` or `NoForces` if no such impulses exist.
    """
    joints = scene.joints.together
    assert joints
    joints.check()
    kick = _kick(scene, joints, t)
    _, motion = joints.coordinates()
    bounces = bounces or {}
    leaves, out = np.zeros(len(kick.response)), np.zeros(len(kick.response), dtype=bool)
    impulse, approach = np.zeros_like(leaves), motion.values
    if bounces:  # velocities at an instant satisfy the constraints only to second order in dt
        out[list(bounces)] = True
        impulse = impulses(kick, approach, leaves, out)
        approach = approach + impulse @ kick.response
    for row, restitution in bounces.items():
        leaves[row] = restitution * min(float(kick.rows_at_start.jacobian[row] @ approach), 0.0)
    impulse = impulse + impulses(kick, approach, leaves, np.zeros_like(out))
    state = scene.batch.state()
    joint_impulses = JointForces(
        joints.jacobian(),
        impulse[kick.layout.joints],
        joints.pulls_only,
        joints.changes,
        np.array(joints.names, dtype=str),
    )
    after = state[:, 3:] + (impulse @ kick.response)[joints.coordinate_indices]
    others = joints.pulls_only.sum() - len(bounces) + len(kick.contacts.bodies)
    elastic = not others and bool(bounces) and min(bounces.values()) == 1
    return Jolt(
        t, state[:, :3], state[:, 3:], after, joint_impulses, kick.contacts_with(impulse), elastic
    )


def _kick(scene: Scene, joints: ExactJoints, t: float) -> Kick:
    """Return the rows of all joints and contacts at the current positions."""
    kept_lengths = joints.kept_lengths(t, t + joints.drift)
    if scene.direct:
        return scene.direct.without_correction(kept_lengths)
    count = len(scene.mass)
    none, never = np.zeros((count, count)), np.zeros((count, count), dtype=bool)
    running = np.zeros((count, 2))
    surfaces = Surfaces(Figures([]), none, none, none, running, 0.0, 0.0, never)
    layout = lay_out(NO_CONTACTS, joints, surfaces, scene.mass > 0)
    return Kick.at(joints.pose(), joints, NO_CONTACTS, layout, running, kept_lengths)
