"""Drag through a fluid at rest."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import drag as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers, in_place
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Drag:
    """F = −(linear + quadratic |v|) v: Stokes's drag, and that of a turbulent wake."""

    effect: ClassVar[Effect] = declared.Drag.effect

    linear: float  # kg/s
    quadratic: float  # kg/m
    bodies: slice | Integers  # those it acts on

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add −(linear + quadratic |v|) v."""
        v = motion.velocity[..., self.bodies, :]
        speed = np.hypot(v[..., 0], v[..., 1])
        wrench[..., self.bodies, :2] -= (self.linear + self.quadratic * speed)[..., None] * v

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: drag dissipates energy."""
        return np.zeros(motion.position.shape[:-1])


def laws(effect: declared.Drag, inputs: LawInputs) -> Iterator[Law]:
    """Yield the drag."""
    rows = in_place(inputs.rows(effect.bodies))
    yield Drag(effect.linear(inputs.values), effect.quadratic(inputs.values), rows)
