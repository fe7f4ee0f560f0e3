"""Force laws that act while their switch is on."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.force_switch import Switch, Switches
from sandbox.physics.forces.law import Law, LawInputs, VelocityRotation
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class SwitchedLaw:
    """A law that acts while its switch is on; while it is off, its potential energy is 0."""

    law: Law
    switch: Switch

    @property
    def effect(self) -> Effect:
        """The declaration of the law."""
        return self.law.effect

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add the force and torque of the law while it is on."""
        acts = self.switch.at(motion.t)
        if acts.any():
            inputs = np.zeros_like(wrench)
            self.law.add(motion, inputs)
            wrench += inputs * acts[..., None, None]

    def potential_energy(self, motion: Motion) -> Array:
        """Return the potential energy of the law, 0 while it is off."""
        return self.law.potential_energy(motion) * self.switch.at(motion.t)[..., None]


@dataclass(frozen=True, slots=True)
class SwitchedRotation:
    """A `VelocityRotation` that acts while its switch is on."""

    turn: VelocityRotation
    switch: Switch

    @property
    def effect(self) -> Effect:
        """The declaration of the law."""
        return self.turn.effect

    def rate(self, motion: Motion) -> Array:
        """Return the rate at which it turns velocities, 0 while it is off."""
        return self.turn.rate(motion) * self.switch.at(motion.t)[..., None]


def switched_laws(
    make: Callable[..., Iterable[Law | VelocityRotation]],
    settings: Any,  # noqa: ANN401 (whatever an effect says)
    name: str,
    inputs: LawInputs,
) -> Iterator[Law | VelocityRotation]:
    """Yield the laws of an effect, with switches for those that events turn on and off."""
    for part, switch in _parts(settings, name, inputs.switches):
        for law in make(part, inputs):
            yield _switched(law, switch) if switch else law


def _parts(settings: Any, name: str, switches: Switches) -> Iterator[tuple[Any, Switch | None]]:  # noqa: ANN401
    """Yield the settings of an effect, split if entries have switches of their own."""
    whole = switches.get(name)
    if not isinstance(settings, tuple):
        yield settings, whole
        return
    own = [one for one in settings if getattr(one, "name", None) in switches]
    if rest := tuple(one for one in settings if one not in own):
        yield rest, whole
    for one in own:
        yield (one,), switches[one.name]


def _switched(law: Law | VelocityRotation, switch: Switch) -> Law | VelocityRotation:
    if law.effect.rotates_velocity:
        return SwitchedRotation(cast("VelocityRotation", law), switch)
    return SwitchedLaw(cast("Law", law), switch)
