"""A given force."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.expressions import Array, Formula, Values
from sandbox.model.shapes import XY
from sandbox.physics.laws.law import Book
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Push:
    """A force on a point of a body, constant or of time, along the plane's axes or the body's.

    Only a constant one along the plane's axes has a potential: U = −F · r, with r the point that it
    acts on. What turns with the body does work on a way round, so it has none.
    """

    effect: ClassVar[str] = "force"

    force: tuple[Formula, Formula]  # N
    values: Values
    body: int
    point: XY  # m, from the centre of mass, along the body's axes
    turns: bool = False  # with the body

    @property
    def book(self) -> Book:
        """Where it has a potential, that; else it does work."""
        changes = self.turns or any("t" in component.names for component in self.force)
        return "work" if changes else "potential"

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add F, and its torque about the centre of mass."""
        x, y = self._force(motion)
        arm_x, arm_y = self._turned(motion, *self.point)
        wrench[..., self.body, 0] += x
        wrench[..., self.body, 1] += y
        wrench[..., self.body, 2] += arm_x * y - arm_y * x

    def potential_energy(self, motion: Motion) -> Array:
        """Return −F · r where the force is constant, zero where it changes."""
        energy = np.zeros(motion.position.shape[:-1])
        if self.book == "potential":
            x, y = self._force(motion)
            arm_x, arm_y = self._turned(motion, *self.point)
            place = motion.position[..., self.body, :]
            energy[..., self.body] = -(x * (place[..., 0] + arm_x) + y * (place[..., 1] + arm_y))
        return energy

    def _force(self, motion: Motion) -> tuple[Array, Array]:
        """Return the force along the plane's axes [N]."""
        x, y = (component.over(self.values, motion.t) for component in self.force)
        return self._turned(motion, x, y) if self.turns else (x, y)

    def _turned(self, motion: Motion, x: Array | float, y: Array | float) -> tuple[Array, Array]:
        """Return along the plane's axes what lies along the body's."""
        angle = motion.angle[..., self.body]
        c, s = np.cos(angle), np.sin(angle)
        return c * x - s * y, s * x + c * y
