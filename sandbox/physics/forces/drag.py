"""Drag through a fluid at rest."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Integers
from sandbox.physics.forces.law import Book
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Drag:
    """F = −(linear + quadratic |v|) v: Stokes's drag, and that of a turbulent wake."""

    effect: ClassVar[str] = "drag"
    book: ClassVar[Book] = "loss"
    needs_velocity: ClassVar[bool] = True

    linear: float  # kg/s
    quadratic: float  # kg/m
    bodies: slice | Integers  # those it acts on

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −(linear + quadratic |v|) v."""
        v = motion.velocity[..., self.bodies, :]
        speed = np.hypot(v[..., 0], v[..., 1])
        wrench[..., self.bodies, :2] -= (self.linear + self.quadratic * speed)[..., None] * v

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: what drag takes never comes back."""
        return np.zeros(motion.position.shape[:-1])
