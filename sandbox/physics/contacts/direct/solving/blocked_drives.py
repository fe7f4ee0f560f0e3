"""Drives that nothing can give way to, such as a plate that is driven against a box on the floor.

If no forces are found, a step may be too long, or no motion at all may be possible. The second is a
matter of geometry: whether velocities exist with which no gap shrinks and all joints hold.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.redundant_systems import least_distance
from sandbox.physics.contacts.direct.rows.kick_system import Kick


def is_blocked(kick: Kick, velocity: Array) -> bool:
    """Return whether no velocities satisfy all rows at the rates that bodies or joints dictate.

    `velocity`, (3 N,), are the present velocities; those of bodies that no impulse moves stay as
    they are [m/s, rad/s].
    """
    free = kick.joints.inverse > 0
    jacobian, layout = kick.rows_at_start.jacobian[:, free], kick.layout
    least = -kick.rows_at_start.jacobian @ np.where(free, 0.0, velocity)
    least[layout.joints] -= kick.joint_rates()
    gaps, held = layout.gaps, layout.problem.free
    limits = np.vstack((jacobian[gaps], jacobian[held], -jacobian[held]))
    wanted = np.concatenate((least[gaps], least[held], -least[held]))
    return bool(np.count_nonzero(wanted)) and least_distance(limits, wanted) is None
