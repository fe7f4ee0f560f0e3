"""Uniform gravity."""

from dataclasses import dataclass
from typing import ClassVar

from sandbox.model.effects import gravity as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.forces.variable_mass import MassFraction, constant_mass
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Gravity:
    """F = m g, U = −m g · r. pymunk applies the force itself, at no cost."""

    effect: ClassVar[Effect] = declared.Gravity.effect

    acceleration: XY  # m/s²
    mass: Array  # (n,) kg at the start, 0 for bodies that nothing moves
    mass_fraction: MassFraction = constant_mass

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add m g."""
        mass = self.mass * self.mass_fraction(motion.t)
        for axis in (0, 1):
            wrench[..., axis] += mass * self.acceleration[axis]

    def potential_energy(self, motion: Motion) -> Array:
        """Return −m g · r."""
        x, y = self.acceleration
        mass = self.mass * self.mass_fraction(motion.t)
        return -mass * (x * motion.position[..., 0] + y * motion.position[..., 1])
