"""A potential given as a formula; the force is its negative gradient."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from sandbox.model.effects import potential as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Function
from sandbox.model.number_bounds import EnergyInField
from sandbox.physics.forces.field import Weight
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Potential:
    """F = −∇U, differentiated symbolically."""

    effect: ClassVar[Effect] = declared.Potential.effect

    energy: EnergyInField  # J, or J/kg
    values: Values
    on: Weight
    _slopes: tuple[Function, Function] = field(init=False)  # N, or N/kg

    def __post_init__(self) -> None:
        """Store the derivatives of U."""
        object.__setattr__(self, "_slopes", (self.energy.slope("x"), self.energy.slope("y")))

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −∇U on each body."""
        position, weight = self._position(motion), self.on.at(motion.t)
        for axis, slope in enumerate(self._slopes):
            wrench[..., self.on.bodies, axis] -= weight * slope.at(self.values, position)

    def potential_energy(self, motion: Motion) -> Array:
        """Return the potential energy U of each body."""
        stored = np.zeros(motion.position.shape[:-1])
        found = self.energy.at(self.values, self._position(motion))
        stored[..., self.on.bodies] = self.on.at(motion.t) * found
        return stored

    def _position(self, motion: Motion) -> dict[str, Array]:
        position = motion.position[..., self.on.bodies, :]
        return {"x": position[..., 0], "y": position[..., 1]}


def laws(entries: Sequence[declared.Potential], inputs: LawInputs) -> Iterator[Law]:
    """Yield each potential."""
    for one in entries:
        yield Potential(one.energy, inputs.values, Weight.of(one.bodies, one.per, inputs))
