"""Force fields."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from sandbox.model.effects import field as declared
from sandbox.model.effects.contract import Effect, Sight
from sandbox.model.expressions import Array, Values
from sandbox.model.number_bounds import ForceInField
from sandbox.physics.engine.space_arrays import Integers, in_place
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import MassFraction
from sandbox.physics.state.motion import Motion

SIGHTS: Mapping[str, Sight] = {
    "x": "position",
    "y": "position",
    "vx": "velocity",
    "vy": "velocity",
    "t": "time",
}
"""The dependence of a force that each variable in its formula means."""


@dataclass(frozen=True, slots=True)
class Weight:
    """The bodies that a field acts on, with equal weights or with their masses as weights."""

    bodies: slice | Integers
    mass: Array | None  # (n,) kg at the start; None for equal weights
    mass_fraction: MassFraction

    @classmethod
    def of(cls, bodies: Sequence[str] | None, per: str, inputs: LawInputs) -> "Weight":
        """Return the weights of the named bodies, or of all dynamic bodies if none are named."""
        rows = in_place(inputs.rows(bodies))
        return cls(rows, inputs.mass if per == "mass" else None, inputs.mass_fraction)

    def at(self, t: Array) -> Array | float:
        """Return the factors of the field at a time: (..., k)."""
        if self.mass is None:
            return 1.0
        return np.asarray((self.mass * self.mass_fraction(t))[..., self.bodies])


@dataclass(frozen=True, slots=True)
class Field:
    """F(x, y, vx, vy, t) by formulas; its energy is booked as work."""

    effect: Effect
    force: tuple[ForceInField, ForceInField]  # N, or N/kg
    values: Values
    on: Weight

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add F on each body."""
        bodies, weight = self.on.bodies, self.on.at(motion.t)
        position, velocity = motion.position[..., bodies, :], motion.velocity[..., bodies, :]
        seen = {
            "x": position[..., 0],
            "y": position[..., 1],
            "vx": velocity[..., 0],
            "vy": velocity[..., 1],
            "t": np.asarray(motion.t)[..., None],
        }
        for axis, component in enumerate(self.force):
            wrench[..., bodies, axis] += weight * component.at(self.values, seen)

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: the force need not have a potential."""
        return np.zeros(motion.position.shape[:-1])


def laws(entries: Sequence[declared.Field], inputs: LawInputs) -> Iterator[Law]:
    """Yield each field, declared to depend only on what its formulas contain."""
    for one in entries:
        used = {SIGHTS[name] for f in one.force for name in f.names & SIGHTS.keys()}
        effect = replace(
            one.effect, depends_on=tuple(s for s in one.effect.depends_on if s in used)
        )
        yield Field(effect, one.force, inputs.values, Weight.of(one.bodies, one.per, inputs))
