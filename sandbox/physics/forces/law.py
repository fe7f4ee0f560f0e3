"""The contract of a force law, and the input from which laws are made.

The law of an effect is in the module of the effect's name in this folder, with a function

    def laws(effect: Drag, inputs: LawInputs) -> Iterator[Law]: ...

which makes it from the level's settings of the effect: a `Law`, or a `VelocityRotation` if the
effect does no work. The effect is declared in `sandbox.model.effects`; a law refers to that
declaration.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.physics.forces.variable_mass import MassFraction
from sandbox.physics.state.motion import Motion, Reading

if TYPE_CHECKING:
    from sandbox.physics.forces.force_switch import Switches


class Law(Protocol):
    """A force, and its potential energy.

    Both take arrays with any number of leading axes, so that the same code serves a step and a
    whole recorded run. A law changes only the rows of the bodies that it acts on.
    """

    @property
    def effect(self) -> Effect:
        """Its declaration: that of an effect, or of springs."""

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add the force and torque on each body [N, N m] to an array, (..., n, 3)."""

    def potential_energy(self, motion: Motion) -> Array:
        """Return the potential energy of each body [J]: (..., n)."""


def exert(law: Law, motion: Motion, wrench: Array) -> None:
    """Add what a law does in a kick in which it sees a motion, and its `path` if it has one."""
    law.add(motion, wrench)
    if isinstance(motion, Reading) and motion.path:
        add_belated(law, motion, wrench)


def add_belated(law: Law, motion: Reading, wrench: Array) -> None:
    """Add what a law makes up for along the path of a motion."""
    if not law.effect.depends_on_velocity:
        return
    now = np.zeros_like(wrench)
    law.add(motion, now)
    for weight, other in motion.path:
        then = np.zeros_like(wrench)
        law.add(other, then)
        wrench += weight * (then - now)  # exactly 0 where it sees the same velocities


class VelocityRotation(Protocol):
    """A force perpendicular to the velocity, F = m ω (−vy, vx), which turns it and does no work.

    A law gives only the rate ω: the kick turns velocities without changing their magnitudes (see
    `sandbox.physics.forces.velocity_rotation`).
    """

    @property
    def effect(self) -> Effect:
        """Its declaration."""

    def rate(self, motion: Motion) -> Array:
        """Return ω of each body, counter-clockwise [rad/s]: (..., n), 0 where it does not act."""


class LawInputs(NamedTuple):
    """The input from which the laws of a level are made."""

    level: Level
    values: Values
    """The level that declares the laws, and the values of its parameters."""
    names: Sequence[str]
    mass: Array
    """(n,), the names of its bodies, and their masses at the start, 0 if nothing moves them [kg].
    """
    mass_fraction: MassFraction
    """The masses over those at the start, as a function of time."""
    step: float
    """The duration of a kick [s]."""
    switches: "Switches" = {}  # noqa: RUF012 (nobody writes to it)
    """The switches of named forces, whole effects and springs that events turn on and off."""

    def row(self, body: str) -> int:
        """Return the row of a body."""
        return self.names.index(body)

    def rows(self, bodies: Sequence[str] | None) -> NDArray[np.intp]:
        """Return the rows of the bodies named, or of all dynamic bodies if none are."""
        return np.flatnonzero(self.mass) if bodies is None else np.array([*map(self.row, bodies)])
