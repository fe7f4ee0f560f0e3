"""The force on a body that loses matter: m dv/dt = F + u dm/dt.

u is the velocity of the lost matter relative to the body (Meshchersky's equation).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.effects import thrust as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import Flow
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Thrust:
    """The thrust of a rocket, F = u dm/dt, with u in the body's axes and dm/dt < 0."""

    effect: ClassVar[Effect] = declared.Thrust.effect

    flow: Flow
    exhaust: XY  # m/s, relative to the body, along its axes
    step: float  # s

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add u dm/dt."""
        body, (x, y) = self.flow.body, self.exhaust
        rate = self.flow.mean_rate(motion.t, self.step)
        angle = motion.angle[..., body]
        c, s = np.cos(angle), np.sin(angle)
        wrench[..., body, 0] += rate * (c * x - s * y)
        wrench[..., body, 1] += rate * (s * x + c * y)

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: thrust has no potential."""
        return np.zeros(motion.position.shape[:-1])


def flows(
    entries: Sequence[declared.Thrust], values: Values, names: Sequence[str]
) -> Iterator[Flow]:
    """Yield the flow of propellant of each rocket, in order."""
    for thrust in entries:
        rate, propellant = thrust.rate(values), thrust.propellant(values)
        yield Flow(names.index(thrust.body), -rate, propellant / rate, thrust.effect.name)


def laws(entries: Sequence[declared.Thrust], inputs: LawInputs) -> Iterator[Law]:
    """Yield the thrust of each rocket."""
    for thrust, flow in zip(entries, flows(entries, inputs.values, inputs.names), strict=True):
        yield Thrust(flow, evaluate(thrust.exhaust, inputs.values), inputs.step)
