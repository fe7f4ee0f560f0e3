"""The depth of points in a polygon: the distance from its outline, negative outside."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.state.joint_anchors import Complexes


def depth(points: Complexes, corners: Complexes) -> Array:
    """Return the depths of points (...) in a polygon, convex or not: (...) [m].

    `corners`, (k,), go round the polygon in order, clockwise or counter-clockwise [m].
    """
    sides = np.roll(corners, -1) - corners
    apart = points[..., None] - corners
    share = np.clip((apart * sides.conj()).real / np.abs(sides) ** 2, 0.0, 1.0)
    distance = np.abs(apart - share * sides).min(axis=-1)
    return np.where(_inside(apart, sides), distance, -distance)


def _inside(apart: Complexes, sides: Complexes) -> Array:
    """Return whether a ray to the right crosses the outline an odd number of times: (...)."""
    low, high = apart.imag >= 0, apart.imag >= sides.imag
    left = apart.real * sides.imag - apart.imag * sides.real
    crosses = (low != high) & ((left < 0) == (sides.imag > 0))
    return np.asarray(np.count_nonzero(crosses, axis=-1) % 2 == 1)
