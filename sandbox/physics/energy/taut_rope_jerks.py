"""Ropes that become taut, and the joints that the resulting jerk reaches."""

import numpy as np

from sandbox.physics.contacts.direct.complementarity.islands import islands
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.joints.joint_forces import JointForces


def reached_by_jerk(
    joint_forces: JointForces, contacts: Contacts, slack: Booleans, movable: Booleans
) -> Booleans:
    """Return which joints' equations a jerk reaches, from body to body: (m,).

    `joint_forces` and `contacts` are the forces in a kick; `slack`, (m,), are the equations that
    did not pull before, and `movable`, (n,), the bodies that can move. A rope that becomes taut in
    a drift is stopped in the kick before it and the kick after it.
    """
    tightened = joint_forces.pulls_only & (joint_forces.tension > 0) & slack
    reached = np.zeros(len(tightened) + len(contacts.bodies), dtype=bool)
    if tightened.any():
        constrained_bodies = [np.flatnonzero(row.any(axis=1)) for row in joint_forces.jacobian]
        for rows in islands([*constrained_bodies, *contacts.bodies], movable):
            reached[rows] = tightened[rows[rows < len(tightened)]].any()
    return reached[: len(tightened)]
