"""The forces of a rotating frame."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import centrifugal as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import MassFraction, constant_mass
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Centrifugal:
    """The plane rotates about a vertical axis in it: F = m ω² (x − x0), U = −m ω² (x − x0)² / 2.

    The Coriolis force, 2 m ω times the horizontal velocity, is perpendicular to the plane, and is
    balanced by whatever keeps bodies in the plane.
    """

    effect: ClassVar[Effect] = declared.Centrifugal.effect

    rate: float  # rad/s, ω
    axis: float  # m, x0
    mass: Array  # (n,) kg at the start, 0 for bodies that nothing moves
    mass_fraction: MassFraction = constant_mass

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add m ω² (x − x0)."""
        mass = self.mass * self.mass_fraction(motion.t)
        wrench[..., 0] += mass * self.rate**2 * (motion.position[..., 0] - self.axis)

    def potential_energy(self, motion: Motion) -> Array:
        """Return −m ω² (x − x0)² / 2."""
        mass = self.mass * self.mass_fraction(motion.t)
        return np.asarray(-mass * self.rate**2 * (motion.position[..., 0] - self.axis) ** 2 / 2)


def laws(effect: declared.Centrifugal, inputs: LawInputs) -> Iterator[Law]:
    """Yield the centrifugal force."""
    rate, axis = effect.rate(inputs.values), effect.axis(inputs.values)
    yield Centrifugal(rate, axis, inputs.mass, inputs.mass_fraction)
