"""The rounding error of a kick whose contacts are solved for the positions after the drift."""

from collections.abc import Sequence

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.constraint_interface import POSITION_ROUNDING

FOOT = 16
"""The rounding error of the foot of a body on a curve, which is found from several positions, as a
multiple of that of a position. What is left of it in a kick differs between processors, 1e-13 to
1e-12 m/s at 500 Hz. In a pile each layer adds its own: up to 8 times as much is left at the top of
200 boxes."""


def velocity_rounding(poses: Array, bodies: Sequence[pymunk.Body], drift: float) -> float:
    """Return the error of velocities by the rounding of poses, (n, 3), over a drift [s] [m/s]."""
    foot = FOOT * POSITION_ROUNDING * float(np.abs(poses).max(initial=0.0))
    return foot * len(bodies) ** 0.5 / drift


def spread(bodies: Sequence[pymunk.Body]) -> float:
    """Return the largest mass over the least: rounding of one moves the other so much more."""
    masses = [body.mass for body in bodies if body.body_type == pymunk.Body.DYNAMIC]
    return max(masses) / min(masses)
