"""Attraction of bodies to each other."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from sandbox.model.effects import gravitation as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import Given, Law
from sandbox.physics.forces.variable_mass import Share, steady
from sandbox.physics.state.motion import Motion

AT_ONCE = 15_000
"""How many pairs are computed at once: their arrays stay in the cache, five times as fast."""


@dataclass(frozen=True, slots=True)
class Gravitation:
    """Newton's, between every two of k bodies: F = G m1 m2 r / s³, U = −G m1 m2 / s.

    s² = r² + ε² is Plummer's softening: without it, the force of bodies that meet has no end. The
    energy of a pair belongs in equal parts to both.
    """

    effect: ClassVar[Effect] = declared.Gravitation.effect

    constant: float  # m³/(kg s²), G
    bodies: NDArray[np.intp]  # (k,)
    mass: Array  # (n,) kg at the start
    softening: float = 0.0  # m, ε
    share: Share = steady

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add to each body the pull of all others."""
        mass = self._mass(motion)
        for some, x, y, square in self._pairs(motion):
            weight = np.sqrt(square)
            weight *= square
            np.divide(self.constant * mass[..., None, :], weight, out=weight)
            rows = self.bodies[some]
            wrench[..., rows, 0] += mass[..., some] * np.einsum("...ij,...ij->...i", weight, x)
            wrench[..., rows, 1] += mass[..., some] * np.einsum("...ij,...ij->...i", weight, y)

    def potential_energy(self, motion: Motion) -> Array:
        """Return −G m1 m2 / s of each pair, half for each of the two."""
        mass = self._mass(motion)
        energy = np.zeros(motion.position.shape[:-1])
        for some, _, _, square in self._pairs(motion):
            others = np.sum(mass[..., None, :] / np.sqrt(square), axis=-1)
            energy[..., self.bodies[some]] = -self.constant * mass[..., some] * others / 2
        return energy

    def _pairs(self, motion: Motion) -> Iterator[tuple[slice, Array, Array, Array]]:
        """Yield some bodies, the ways from them to all, and s²: as many as fit into a cache."""
        places = np.ascontiguousarray(np.moveaxis(motion.position[..., self.bodies, :], -1, 0))
        count = len(self.bodies)
        rows = max(AT_ONCE // max(places[0].size, 1), 1)
        for start in range(0, count, rows):
            some = slice(start, min(start + rows, count))
            x, y = (place[..., None, :] - place[..., some, None] for place in places)
            square = x * x
            square += y * y
            square += self.softening**2
            own = np.arange(some.stop - start)
            square[..., own, start + own] = np.inf  # none pulls itself
            yield some, x, y, square

    def _mass(self, motion: Motion) -> Array:
        """Return the masses of the bodies at the time: (..., k) [kg]."""
        mass: Array = (self.mass * self.share(motion.t))[..., self.bodies]
        return mass


def laws(said: declared.Gravitation, given: Given) -> Iterator[Law]:
    """Yield what all pull at each other with."""
    constant, softening = said.constant(given.values), said.softening(given.values)
    yield Gravitation(constant, given.rows(said.bodies), given.mass, softening, given.share)
