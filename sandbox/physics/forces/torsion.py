"""Torsion springs, between a body and the plane or another body."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import torsion as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.torque import TorquePair
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Torsion:
    """τ = −k (θ − θ0), U = k (θ − θ0)² / 2; the energy belongs to the first body."""

    effect: ClassVar[Effect] = declared.Torsion.effect

    stiffness: float  # N m/rad, k
    angle: float  # rad, θ0
    on: TorquePair

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −k (θ − θ0) on the body, and its reaction."""
        self.on.add(-self.stiffness * self._twist(motion), wrench)

    def potential_energy(self, motion: Motion) -> Array:
        """Return k (θ − θ0)² / 2."""
        stored = np.zeros(motion.position.shape[:-1])
        stored[..., self.on.body] = self.stiffness * self._twist(motion) ** 2 / 2
        return stored

    def _twist(self, motion: Motion) -> Array:
        return self.on.between(motion.angle) - self.angle


def laws(entries: Sequence[declared.Torsion], inputs: LawInputs) -> Iterator[Law]:
    """Yield each torsion spring."""
    for one in entries:
        turned = TorquePair.of(one.body, one.against, inputs)
        yield Torsion(one.stiffness(inputs.values), one.angle(inputs.values), turned)
