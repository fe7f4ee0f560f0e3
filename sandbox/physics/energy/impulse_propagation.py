"""Ropes that become taut, and the joints that the resulting jerk reaches."""

import numpy as np

from sandbox.physics.contacts.direct.complementarity.islands import islands
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.joints.joint_forces import JointForces


def reached(pulls: JointForces, contacts: Contacts, slack: Booleans, moves: Booleans) -> Booleans:
    """Return which joints' equations a jerk reaches, from body to body: (m,).

    `pulls` and `contacts` are the forces in a kick; `slack`, (m,), are the equations that did not
    pull before, and `moves`, (n,), the bodies that can move. A rope that becomes taut in a drift is
    stopped in the kick before it and the kick after it.
    """
    caught = pulls.pulls_only & (pulls.tension > 0) & slack
    found = np.zeros(len(caught) + len(contacts.bodies), dtype=bool)
    if caught.any():
        held = [np.flatnonzero(row.any(axis=1)) for row in pulls.jacobian]
        for rows in islands([*held, *contacts.bodies], moves):
            found[rows] = caught[rows[rows < len(caught)]].any()
    return found[: len(caught)]
