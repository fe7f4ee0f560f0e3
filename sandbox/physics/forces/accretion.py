"""The force on a body that gathers matter: m dv/dt = F + (w − v) dm/dt.

w is the velocity of the gathered matter (Meshchersky's equation).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import accretion as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import Flow
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Accretion:
    """The force on a body that gathers matter of velocity w: F = (w − v) dm/dt."""

    effect: ClassVar[Effect] = declared.Accretion.effect

    flow: Flow
    velocity: XY  # m/s, w
    step: float  # s

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add (w − v) dm/dt."""
        body = self.flow.body
        rate = self.flow.mean_rate(motion.t, self.step)
        wrench[..., body, :2] += rate[..., None] * (self.velocity - motion.velocity[..., body, :])

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: accretion has no potential."""
        return np.zeros(motion.position.shape[:-1])


def flows(
    entries: Sequence[declared.Accretion], values: Values, names: Sequence[str]
) -> Iterator[Flow]:
    """Yield the flow of matter of each accretion, in order."""
    for one in entries:
        yield Flow(names.index(one.body), one.rate(values), effect=one.effect.name)


def laws(entries: Sequence[declared.Accretion], inputs: LawInputs) -> Iterator[Law]:
    """Yield the force of each accretion."""
    for one, flow in zip(entries, flows(entries, inputs.values, inputs.names), strict=True):
        yield Accretion(flow, evaluate(one.velocity, inputs.values), inputs.step)
