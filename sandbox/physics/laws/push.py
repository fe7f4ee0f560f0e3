"""A given force."""

from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array, Formula, Values
from sandbox.model.shapes import XY
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Push:
    """A force on a point of a body, constant or of time; it has a potential only if constant.

    U = −F · r, with r the point that it acts on.
    """

    force: tuple[Formula, Formula]  # N
    values: Values
    body: int
    point: XY  # m, from the centre of mass, along the body's axes

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add F, and its torque about the centre of mass."""
        x, y = self._force(motion)
        arm_x, arm_y = self._arm(motion)
        wrench[..., self.body, 0] += x
        wrench[..., self.body, 1] += y
        wrench[..., self.body, 2] += arm_x * y - arm_y * x

    def potential_energy(self, motion: Motion) -> Array:
        """Return −F · r where the force is constant, zero where it depends on time."""
        energy = np.zeros(motion.position.shape[:-1])
        if not any("t" in component.names for component in self.force):
            x, y = self._force(motion)
            arm_x, arm_y = self._arm(motion)
            place = motion.position[..., self.body, :]
            energy[..., self.body] = -(x * (place[..., 0] + arm_x) + y * (place[..., 1] + arm_y))
        return energy

    def _force(self, motion: Motion) -> tuple[Array, Array]:
        x, y = (component.over(self.values, motion.t) for component in self.force)
        return x, y

    def _arm(self, motion: Motion) -> tuple[Array, Array]:
        """Return the point, from the centre of mass, in the plane [m]."""
        angle = motion.angle[..., self.body]
        c, s = np.cos(angle), np.sin(angle)
        (x, y) = self.point
        return c * x - s * y, s * x + c * y
