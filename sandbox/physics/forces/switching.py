"""Forces that events switch: a law that acts while its switch is on.

A switch knows when it was thrown, so that a recorded run, too, tells what acted at each instant.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np

from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import Given, Law, Turn
from sandbox.physics.state.motion import Motion


@dataclass(slots=True)
class Switch:
    """Whether something acts, and when that has changed.

    Attributes
    ----------
    first
        Whether it acts at the start.
    thrown
        The times at which it was thrown, in order [s].
    """

    first: bool
    thrown: list[float] = field(default_factory=list)

    def turn(self, t: float, *, on: bool) -> None:
        """Let it be on, or off, from a time on [s]."""
        if self.now is not on:
            self.thrown.append(t)

    @property
    def now(self) -> bool:
        """Whether it acts by now."""
        return self.first is not bool(len(self.thrown) % 2)

    def at(self, t: Array) -> Array:
        """Return 1 at the times at which it acts, 0 at others: (...)."""
        count = np.searchsorted(np.array(self.thrown), t, side="right")
        return np.asarray((count % 2 == 1) != self.first, dtype=float)


Switches = Mapping[str, Switch]
"""By the names of the effects, forces and springs that they switch."""


@dataclass(frozen=True, slots=True)
class SwitchedLaw:
    """A law that acts while its switch is on; what it stores then is gone when it is off."""

    law: Law
    switch: Switch

    @property
    def effect(self) -> Effect:
        """What declares the law."""
        return self.law.effect

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add force and torque of the law where it is on."""
        acts = self.switch.at(motion.t)
        if acts.any():
            given = np.zeros_like(wrench)
            self.law.add(motion, given)
            wrench += given * acts[..., None, None]

    def potential_energy(self, motion: Motion) -> Array:
        """Return what the law stores where it is on."""
        return self.law.potential_energy(motion) * self.switch.at(motion.t)[..., None]


@dataclass(frozen=True, slots=True)
class SwitchedTurn:
    """What turns velocities while its switch is on."""

    turn: Turn
    switch: Switch

    @property
    def effect(self) -> Effect:
        """What declares it."""
        return self.turn.effect

    def rate(self, motion: Motion) -> Array:
        """Return how fast it turns velocities where it is on."""
        return self.turn.rate(motion) * self.switch.at(motion.t)[..., None]


def switched_laws(
    make: Callable[..., Iterable[Law | Turn]],
    said: Any,  # noqa: ANN401 (whatever an effect says)
    name: str,
    given: Given,
) -> Iterator[Law | Turn]:
    """Yield the laws of an effect; what events switch acts while it is on."""
    for part, switch in _parts(said, name, given.switches):
        for law in make(part, given):
            yield _switched(law, switch) if switch else law


def _parts(said: Any, name: str, switches: Switches) -> Iterator[tuple[Any, Switch | None]]:  # noqa: ANN401
    """Yield what a level says of an effect, apart where it is switched apart."""
    whole = switches.get(name)
    if not isinstance(said, tuple):
        yield said, whole
        return
    own = [one for one in said if getattr(one, "name", None) in switches]
    if rest := tuple(one for one in said if one not in own):
        yield rest, whole
    for one in own:
        yield (one,), switches[one.name]


def _switched(law: Law | Turn, switch: Switch) -> Law | Turn:
    if hasattr(law, "rate"):
        return SwitchedTurn(cast("Turn", law), switch)
    return SwitchedLaw(cast("Law", law), switch)
