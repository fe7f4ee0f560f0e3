"""Torques that a level prescribes, on one body or between two."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from sandbox.model.effects import torque as declared
from sandbox.model.effects.contract import Effect, Sight
from sandbox.model.expressions import Array, Values
from sandbox.model.number_bounds import TorqueOfTurning
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.state.motion import Motion

SIGHTS: Mapping[str, Sight] = {"theta": "angle", "omega": "velocity", "t": "time"}
"""The dependence of a torque that each variable in its formula means."""


@dataclass(frozen=True, slots=True)
class TorquePair:
    """A body on which a torque acts, and the body on which its reaction acts, if any."""

    body: int
    against: int | None

    @classmethod
    def of(cls, body: str, against: str | None, inputs: LawInputs) -> "TorquePair":
        """Return the bodies that a level names."""
        return cls(inputs.row(body), None if against is None else inputs.row(against))

    def between(self, values: Array) -> Array:
        """Return the relative angle of the two bodies, or its rate, from the values of all."""
        own: Array = values[..., self.body]
        return own if self.against is None else own - values[..., self.against]

    def add(self, torque: Array, wrench: Array) -> None:
        """Add a torque on the body, and its reaction on the other."""
        wrench[..., self.body, 2] += torque
        if self.against is not None:
            wrench[..., self.against, 2] -= torque


@dataclass(frozen=True, slots=True)
class Torque:
    """τ(θ, ω, t) by a formula; its energy is booked as work."""

    effect: Effect
    torque: TorqueOfTurning  # N m
    values: Values
    on: TorquePair

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add τ, and its reaction."""
        seen = {
            "theta": self.on.between(motion.angle),
            "omega": self.on.between(motion.angular_velocity),
            "t": np.asarray(motion.t),
        }
        self.on.add(self.torque.at(self.values, seen), wrench)

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: the torque need not have a potential."""
        return np.zeros(motion.position.shape[:-1])


def laws(entries: Sequence[declared.Torque], inputs: LawInputs) -> Iterator[Law]:
    """Yield each torque, declared to depend only on what its formula contains."""
    for one in entries:
        used = {SIGHTS[name] for name in one.torque.names & SIGHTS.keys()}
        effect = replace(
            one.effect, depends_on=tuple(s for s in one.effect.depends_on if s in used)
        )
        turned = TorquePair.of(one.body, one.against, inputs)
        yield Torque(effect, one.torque, inputs.values, turned)
