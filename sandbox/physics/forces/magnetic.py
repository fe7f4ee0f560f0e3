"""A uniform magnetic field perpendicular to the plane."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import magnetic as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import LawInputs, VelocityRotation
from sandbox.physics.forces.variable_mass import MassFraction, constant_mass
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Magnetic:
    """F = q v × B: every velocity turns at the rate ω = −q B / m."""

    effect: ClassVar[Effect] = declared.Magnetic.effect

    rates: Array  # (n,) rad/s with the masses at the start, 0 for bodies without a charge
    mass_fraction: MassFraction = constant_mass

    def rate(self, motion: Motion) -> Array:
        """Return −q B / m."""
        return np.broadcast_to(
            self.rates / self.mass_fraction(motion.t), motion.velocity.shape[:-1]
        )


def laws(effect: declared.Magnetic, inputs: LawInputs) -> Iterator[VelocityRotation]:
    """Yield the field."""
    field, rates = effect.field(inputs.values), np.zeros(len(inputs.names))
    for charged in effect.charges:
        row = inputs.row(charged.body)
        rates[row] -= charged.charge(inputs.values) * field / inputs.mass[row]
    yield Magnetic(rates, inputs.mass_fraction)
