"""Uniform gravity."""

from dataclasses import dataclass

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Gravity:
    """F = m g, U = −m g · r. pymunk applies it itself, at no cost."""

    acceleration: XY  # m/s²
    mass: Array  # (n,) kg, 0 for bodies that nothing moves

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:  # noqa: ARG002 (it is the same anywhere)
        """Add m g."""
        for axis in (0, 1):
            wrench[..., axis] += self.mass * self.acceleration[axis]

    def potential_energy(self, motion: Motion) -> Array:
        """Return −m g · r."""
        x, y = self.acceleration
        return -self.mass * (x * motion.position[..., 0] + y * motion.position[..., 1])
