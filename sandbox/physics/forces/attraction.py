"""Attraction to a fixed centre."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from sandbox.model.effects import attraction as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.engine.space_arrays import Integers, in_place
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import MassFraction, constant_mass
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Attraction:
    """F = −mu m r / |r|^(p + 1), U = −mu m |r|^(1 − p) / (p − 1), or mu m ln |r| if p is 1.

    With p = 2 it is Newton's law, and U = −mu m / |r|.
    """

    effect: ClassVar[Effect] = declared.Attraction.effect

    mu: float  # m^(p + 1)/s²
    center: XY  # m
    mass: Array  # (n,) kg at the start, 0 for bodies that nothing moves
    power: float = 2.0  # p
    mass_fraction: MassFraction = constant_mass
    _moving: slice | Integers = field(init=False)  # the bodies that it acts on
    _center: Array = field(init=False)  # the centre [m]
    _strength: Array = field(
        init=False
    )  # mu m of these bodies, unless it changes [m^(p + 1) kg/s²]

    def __post_init__(self) -> None:
        """Store the moving bodies, the centre as an array, and how strongly each is attracted."""
        moving = in_place(np.flatnonzero(self.mass))
        object.__setattr__(self, "_moving", moving)
        object.__setattr__(self, "_center", np.array(self.center))
        object.__setattr__(self, "_strength", (self.mu * self.mass)[moving])

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −mu m r / |r|^(p + 1)."""
        r, distance, strength = self._distances(motion)
        pull = strength / distance ** (self.power + 1)
        wrench[..., self._moving, :2] -= pull[..., None] * r

    def potential_energy(self, motion: Motion) -> Array:
        """Return −mu m |r|^(1 − p) / (p − 1), or mu m ln |r|."""
        _, distance, strength = self._distances(motion)
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., self._moving] = strength * self._integral(distance)
        return energy

    def _distances(self, motion: Motion) -> tuple[Array, Array, Array]:
        """Return r, |r| and mu m of the moving bodies."""
        r = motion.position[..., self._moving, :] - self._center
        distance = np.hypot(r[..., 0], r[..., 1])
        if self.mass_fraction is constant_mass:
            return r, distance, self._strength
        strength = self.mu * self.mass * self.mass_fraction(motion.t)
        return r, distance, strength[..., self._moving]

    def _integral(self, distance: Array) -> Array:
        """Return the integral of r^(−p) over r."""
        if self.power == 1:
            return np.log(distance)
        return -1 / ((self.power - 1) * distance ** (self.power - 1))


def laws(entries: Sequence[declared.Attraction], inputs: LawInputs) -> Iterator[Law]:
    """Yield the attraction to each centre."""
    values = inputs.values
    for one in entries:
        center, power = evaluate(one.center, values), one.power(values)
        yield Attraction(one.mu(values), center, inputs.mass, power, inputs.mass_fraction)
