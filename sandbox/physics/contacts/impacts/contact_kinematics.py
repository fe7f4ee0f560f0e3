"""The velocities of points of bodies, and the Jacobian of contacts."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers


def point_velocity(rate: Array, arm: Array) -> Array:
    """Return v + ω × r of points of bodies, or the same of accelerations: (..., 2) [m/s].

    `rate`, (..., 3), are the velocities of the bodies [m/s, rad/s], and `arm`, (..., 2), the lever
    arms from their centres to the points [m].
    """
    across = np.empty(arm.shape)
    np.negative(arm[..., 1], out=across[..., 0])
    across[..., 1] = arm[..., 0]
    velocity: Array = rate[..., :2] + rate[..., 2:] * across
    return velocity


def pair_jacobian(arm: Array, direction: Array) -> Array:
    """Return the Jacobian of the relative velocity of two bodies along a direction: (k, 2, 3).

    `arm`, (k, 2, 2), are the lever arms from the centre of each body to the contact point [m];
    `direction`, (k, 2), are unit vectors: the normals or the tangents.
    """
    jacobian = np.empty((len(direction), 2, 3))
    jacobian[:, :, :2] = direction[:, None]
    jacobian[:, :, 2] = arm[..., 0] * direction[:, None, 1] - arm[..., 1] * direction[:, None, 0]
    jacobian[:, 0] *= -1
    return jacobian


def over_bodies(jacobian: Array, bodies: Integers, count: int) -> Array:
    """Return the Jacobian of pairs, (k, 2, 3), expanded to all bodies: (k, n, 3)."""
    whole = np.zeros((len(bodies), count, 3))
    whole[np.arange(len(bodies))[:, None], bodies] = jacobian
    return whole
