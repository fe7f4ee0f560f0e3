"""Attraction of bodies to each other."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.laws.law import Book
from sandbox.physics.massflow import Share, steady
from sandbox.physics.motion import Motion


@dataclass(frozen=True, slots=True)
class Gravitation:
    """Newton's, between every two of k bodies: F = G m1 m2 r / s³, U = −G m1 m2 / s.

    s² = r² + ε² is Plummer's softening: without it, the force of bodies that meet has no end. The
    energy of a pair belongs in equal parts to both.
    """

    effect: ClassVar[str] = "gravitation"
    book: ClassVar[Book] = "potential"

    constant: float  # m³/(kg s²), G
    bodies: NDArray[np.intp]  # (k,)
    mass: Array  # (n,) kg at the start
    softening: float = 0.0  # m, ε
    share: Share = steady

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return False

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add to each body the pull of all others."""
        place = np.moveaxis(motion.position[..., self.bodies, :], -1, 0)
        x, y = place[..., None, :] - place[..., None]  # from each (first) to all
        square = x * x + y * y + self.softening**2
        np.einsum("...ii->...i", square)[...] = np.inf  # none pulls itself
        mass = self._mass(motion)
        pull = mass[..., None] * mass[..., None, :]
        pull = self.constant * pull / (square * np.sqrt(square))
        wrench[..., self.bodies, 0] += np.sum(pull * x, axis=-1)
        wrench[..., self.bodies, 1] += np.sum(pull * y, axis=-1)

    def potential_energy(self, motion: Motion) -> Array:
        """Return −G m1 m2 / s of each pair, half for each of the two.

        One body after the other: a long run of many bodies has too many pairs for one array.
        """
        place = motion.position[..., self.bodies, :]
        found = np.zeros(place.shape[:-1])
        mass = self._mass(motion)
        for i in range(len(self.bodies) - 1):
            reach = place[..., i + 1 :, :] - place[..., i : i + 1, :]
            soft = np.sqrt(np.sum(reach * reach, axis=-1) + self.softening**2)
            pair = -self.constant * mass[..., i : i + 1] * mass[..., i + 1 :] / soft
            found[..., i] += pair.sum(axis=-1) / 2
            found[..., i + 1 :] += pair / 2
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., self.bodies] = found
        return energy

    def _mass(self, motion: Motion) -> Array:
        """Return the masses of the bodies at the time: (..., k) [kg]."""
        mass: Array = (self.mass * self.share(motion.t))[..., self.bodies]
        return mass
