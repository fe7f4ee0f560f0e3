"""Where a joint holds on."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.motion import Motion

Plane = NDArray[np.complex128]
"""Points or vectors of the plane, as x + iy."""


@dataclass(frozen=True, slots=True)
class Anchor:
    """A point of a body, from its centre of mass along its axes; of the plane if the body is None.

    The plane is complex: x + iy [m].
    """

    body: int | None
    point: complex = 0j

    def look(self, motion: Motion) -> tuple[Plane, Plane, Plane]:
        """Return where it is [m], how it moves [m/s], and its arm from the centre of mass [m]."""
        if self.body is None:
            here = np.asarray(self.point)
            return here, np.zeros_like(here), np.zeros_like(here)
        x, y = np.moveaxis(motion.position[..., self.body, :], -1, 0)
        u, v = np.moveaxis(motion.velocity[..., self.body, :], -1, 0)
        arm = self.point * np.exp(1j * motion.angle[..., self.body])
        turning = 1j * motion.angular_velocity[..., self.body] * arm
        return x + 1j * y + arm, u + 1j * v + turning, arm


def length(path: Sequence[Anchor], motion: Motion) -> Array:
    """Return how long it is from the first of some points to the last, through all others [m]."""
    places = [anchor.look(motion)[0] for anchor in path]
    return np.asarray(sum(np.abs(b - a) for a, b in pairwise(places)))
