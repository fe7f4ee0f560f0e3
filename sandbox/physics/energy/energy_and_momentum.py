"""The energy and the momentum of bodies in motion."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model import ledger_accounts
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.forces.variable_mass import MassFraction
from sandbox.physics.state.motion import Instant, momentum

if TYPE_CHECKING:
    from sandbox.physics.forces.law import Law


class MechanicalEnergy:
    """Energy and momentum from the masses of n bodies and the laws that store energy.

    `inertia`, (n, 3), are masses, masses and moments at the start [kg, kg m²]; `mass_fraction`
    returns the remaining share of each at a time [s].
    """

    def __init__(
        self, level: Level, laws: Sequence["Law"], inertia: Array, mass_fraction: MassFraction
    ) -> None:
        self._start, self._mass_fraction = inertia, mass_fraction
        self._stores = [law for law in laws if law.effect.book == "potential"]
        self._accounts = dict.fromkeys(ledger_accounts.potentials(level), 0.0)

    def inertia(self, t: float | Array) -> Array:
        """Return masses, masses and moments at a time: (n, 3) [kg, kg m²]."""
        fraction = np.asarray(self._mass_fraction(np.asarray(t)))
        return self._start * (fraction[:, None] if fraction.ndim else fraction)

    def kinetic(self, motion: Instant) -> float:
        """Return the kinetic energy [J]."""
        velocity = velocity_of(motion)
        return float(np.sum(self.inertia(motion.t) * velocity * velocity) / 2)

    def potential(self, motion: Instant) -> float:
        """Return the potential energy [J]."""
        return sum(float(law.potential_energy(motion).sum()) for law in self._stores)

    def potential_by_account(self, motion: Instant) -> dict[str, float]:
        """Return the potential energy, by account [J]."""
        energies = dict(self._accounts)
        for law in self._stores:
            energies[law.effect.account_name] += float(law.potential_energy(motion).sum())
        return energies

    def potential_change_by_mass(self, motion: Instant, t: float) -> Array:
        """Return the change of potential energy with the masses at another time: (n,) [J]."""
        other = motion._replace(t=np.asarray(t))
        more = [law.potential_energy(other) - law.potential_energy(motion) for law in self._stores]
        return sum(more, np.zeros(len(self._start)))

    def momentum(self, motion: Instant) -> Array:
        """Return the momentum, and the angular momentum about the origin: (3,) [kg m/s, J s]."""
        return momentum(self.inertia(motion.t) * velocity_of(motion), motion.position)


def velocity_of(motion: Instant) -> Array:
    """Return velocities and angular velocities: (n, 3) [m/s, rad/s]."""
    return np.column_stack((motion.velocity, motion.angular_velocity))
