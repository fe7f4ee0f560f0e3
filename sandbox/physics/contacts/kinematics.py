"""The velocities of points of bodies, and the Jacobian of touching pairs."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Integers


def point_velocity(rate: Array, arm: Array) -> Array:
    """Return v + ω × r of points of bodies, or so much of an acceleration: (..., 2) [m/s].

    Parameters
    ----------
    rate
        (..., 3), of the bodies [m/s, rad/s].
    arm
        (..., 2), from their centres to the points [m].
    """
    across = np.empty(arm.shape)
    np.negative(arm[..., 1], out=across[..., 0])
    across[..., 1] = arm[..., 0]
    moves: Array = rate[..., :2] + rate[..., 2:] * across
    return moves


def pair_jacobian(arm: Array, way: Array) -> Array:
    """Return how velocities move the second of two bodies over the first along a way: (k, 2, 3).

    Parameters
    ----------
    arm
        (k, 2, 2), from the centre of each body to where they touch [m].
    way
        (k, 2), unit vectors: the normals, or what runs along the surfaces.
    """
    jacobian = np.empty((len(way), 2, 3))
    jacobian[:, :, :2] = way[:, None]
    jacobian[:, :, 2] = arm[..., 0] * way[:, None, 1] - arm[..., 1] * way[:, None, 0]
    jacobian[:, 0] *= -1
    return jacobian


def over_bodies(jacobian: Array, bodies: Integers, count: int) -> Array:
    """Return the Jacobian of pairs, (k, 2, 3), with a place for every body: (k, n, 3)."""
    whole = np.zeros((len(bodies), count, 3))
    whole[np.arange(len(bodies))[:, None], bodies] = jacobian
    return whole
