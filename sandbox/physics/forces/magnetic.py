"""A uniform magnetic field perpendicular to the plane."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import magnetic as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import LawInputs, VelocityRotation
from sandbox.physics.forces.variable_mass import Share, steady
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Magnetic:
    """F = q v × B: every velocity turns at the rate ω = −q B / m."""

    effect: ClassVar[Effect] = declared.Magnetic.effect

    turning: Array  # (n,) rad/s with the masses at the start, 0 for bodies without a charge
    share: Share = steady

    def rate(self, motion: Motion) -> Array:
        """Return −q B / m."""
        return np.broadcast_to(self.turning / self.share(motion.t), motion.velocity.shape[:-1])


def laws(said: declared.Magnetic, given: LawInputs) -> Iterator[VelocityRotation]:
    """Yield the field."""
    field, turning = said.field(given.values), np.zeros(len(given.names))
    for charged in said.charges:
        row = given.row(charged.body)
        turning[row] -= charged.charge(given.values) * field / given.mass[row]
    yield Magnetic(turning, given.share)
