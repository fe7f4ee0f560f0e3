"""Anchors: the points of bodies to which joints are attached."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.state.motion import Motion

Complexes = NDArray[np.complex128]
"""Points or vectors of the plane, as x + iy."""

_NOTHING: Complexes = np.zeros((), dtype=complex)


@dataclass(frozen=True, slots=True)
class Anchor:
    """A point of a body, from its centre of mass in its axes; of the plane if the body is None.

    The plane is complex: x + iy [m].
    """

    body: int | None
    point: complex = 0j

    def kinematics(self, motion: Motion) -> tuple[Complexes, Complexes, Complexes]:
        """Return its position [m], velocity [m/s], and lever arm from the centre of mass [m]."""
        position, arm = self.position_and_arm(motion)
        if self.body is None:
            return position, _NOTHING, arm
        velocity = _plane(motion.velocity[..., self.body, :])
        if self.point:
            velocity = velocity + 1j * motion.angular_velocity[..., self.body] * arm
        return position, velocity, arm

    def position_and_arm(self, motion: Motion) -> tuple[Complexes, Complexes]:
        """Return its position [m], and its lever arm from the centre of mass [m]."""
        if self.body is None:
            return np.asarray(self.point), _NOTHING
        position = _plane(motion.position[..., self.body, :])
        if not self.point:  # the angle does not matter
            return position, _NOTHING
        arm = self.point * np.exp(1j * motion.angle[..., self.body])
        return position + arm, arm


def _plane(vectors: Array) -> Complexes:
    """Return vectors as x + iy: (...) of (..., 2)."""
    return np.ascontiguousarray(vectors).view(complex)[..., 0][()]


def path_length(path: Sequence[Anchor], motion: Motion) -> Array:
    """Return the length of a path through points [m]."""
    positions = [anchor.position_and_arm(motion)[0] for anchor in path]
    return np.asarray(sum(np.abs(b - a) for a, b in pairwise(positions)))
