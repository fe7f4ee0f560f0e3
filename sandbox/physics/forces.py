"""The force laws that a level may declare, each with its potential energy.

Every law works on arrays with any number of leading dimensions, so that the same lines serve one
step and a whole recorded run.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sandbox.model.effects import Effects
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import XY, evaluate


class Force(Protocol):
    """A force on every dynamic body, and the energy that it can give back."""

    def force(self, position: Array, mass: Array) -> Array:
        """Return the force on each body [N]: (..., n, 2), from positions of that shape [m]."""
        ...

    def potential_energy(self, position: Array, mass: Array) -> Array:
        """Return the potential energy of each body [J]: (..., n)."""
        ...


@dataclass(frozen=True, slots=True)
class Gravity:
    """Uniform gravity: F = m g, U = −m g · r. pymunk applies it itself, at no cost."""

    acceleration: XY  # m/s²

    def force(self, position: Array, mass: Array) -> Array:
        """Return m g."""
        return np.broadcast_to(mass[:, None] * np.array(self.acceleration), position.shape)

    def potential_energy(self, position: Array, mass: Array) -> Array:
        """Return −m g · r."""
        x, y = self.acceleration
        return -mass * (x * position[..., 0] + y * position[..., 1])


@dataclass(frozen=True, slots=True)
class Attraction:
    """Newtonian attraction to a fixed centre: F = −mu m r / |r|³, U = −mu m / |r|."""

    mu: float  # m³/s²
    center: XY  # m

    def force(self, position: Array, mass: Array) -> Array:
        """Return −mu m r / |r|³."""
        r = position - np.array(self.center)
        distance = np.sqrt(np.sum(r * r, axis=-1))
        return (-self.mu * mass / distance**3)[..., None] * r

    def potential_energy(self, position: Array, mass: Array) -> Array:
        """Return −mu m / |r|."""
        distance = np.sqrt(np.sum((position - np.array(self.center)) ** 2, axis=-1))
        return -self.mu * mass / distance


def gravity(effects: Effects, values: Values) -> Gravity | None:
    """Return the level's uniform gravity, if it declares any."""
    if effects.gravity is None:
        return None
    return Gravity(evaluate(effects.gravity.acceleration, values))


def force_laws(effects: Effects, values: Values) -> tuple[Force, ...]:
    """Return the declared laws that pymunk does not apply by itself."""
    return tuple(
        Attraction(attraction.mu(values), evaluate(attraction.center, values))
        for attraction in effects.attraction or ()
    )
