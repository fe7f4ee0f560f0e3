"""Attraction to a fixed centre."""

from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Attraction:
    """Newton's: F = −mu m r / |r|³, U = −mu m / |r|."""

    mu: float  # m³/s²
    center: XY  # m
    mass: Array  # (n,) kg, 0 for bodies that nothing moves

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −mu m r / |r|³."""
        moving = self.mass > 0
        r = motion.position[..., moving, :] - self.center
        distance = np.hypot(r[..., 0], r[..., 1])
        wrench[..., moving, :2] += (-self.mu * self.mass[moving] / distance**3)[..., None] * r

    def potential_energy(self, motion: Motion) -> Array:
        """Return −mu m / |r|."""
        moving = self.mass > 0
        r = motion.position[..., moving, :] - self.center
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., moving] = -self.mu * self.mass[moving] / np.hypot(r[..., 0], r[..., 1])
        return energy
