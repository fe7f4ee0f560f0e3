"""Attraction to a fixed centre."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.laws.law import Book
from sandbox.physics.massflow import Share, steady
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Attraction:
    """F = −mu m r / |r|^(p + 1), U = −mu m |r|^(1 − p) / (p − 1), or mu m ln |r| if p is 1.

    With p = 2 it is Newton's, and U = −mu m / |r|.
    """

    effect: ClassVar[str] = "attraction"
    book: ClassVar[Book] = "potential"

    mu: float  # m^(p + 1)/s²
    center: XY  # m
    mass: Array  # (n,) kg at the start, 0 for bodies that nothing moves
    power: float = 2.0  # p
    share: Share = steady

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −mu m r / |r|^(p + 1)."""
        moving, mass = self.mass > 0, self.mass * self.share(motion.t)
        r = motion.position[..., moving, :] - self.center
        distance = np.hypot(r[..., 0], r[..., 1])
        pull = -self.mu * mass[..., moving] / distance ** (self.power + 1)
        wrench[..., moving, :2] += pull[..., None] * r

    def potential_energy(self, motion: Motion) -> Array:
        """Return −mu m |r|^(1 − p) / (p − 1), or mu m ln |r|."""
        moving, mass = self.mass > 0, self.mass * self.share(motion.t)
        r = motion.position[..., moving, :] - self.center
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., moving] = (
            self.mu * mass[..., moving] * self._well(np.hypot(r[..., 0], r[..., 1]))
        )
        return energy

    def _well(self, distance: Array) -> Array:
        """Return the integral of distance^(−p)."""
        if self.power == 1:
            return np.log(distance)
        return -1 / ((self.power - 1) * distance ** (self.power - 1))
