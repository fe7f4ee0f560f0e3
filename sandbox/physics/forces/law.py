"""The contract of a force law, and what laws are made from.

The law of an effect is a module of its name in this folder, with a function

    def laws(said: Drag, given: Given) -> Iterator[Law]: ...

which makes it from what a level says of the effect: a `Law`, or, of an effect that does no work, a
`Turn`. The declaration of the effect is in `sandbox.model.effects`; a law passes it on.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.physics.forces.variable_mass import Share
from sandbox.physics.state.motion import Motion

if TYPE_CHECKING:
    from sandbox.physics.forces.switch import Switches


class Law(Protocol):
    """A force, and the energy that it can give back.

    Both work on arrays with any number of leading dimensions, so that the same lines serve a step
    and a whole recorded run. A law touches only the bodies that it acts on.
    """

    @property
    def effect(self) -> Effect:
        """The declaration: an effect's, or a spring's."""
        ...

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add force and torque on each body [N, N m] to an array: (..., n, 3)."""
        ...

    def potential_energy(self, motion: Motion) -> Array:
        """Return the potential energy of each body [J]: (..., n)."""
        ...


class Turn(Protocol):
    """A force at right angles to the velocity, F = m ω (−vy, vx): it turns it, and does no work.

    A law says how fast, and no more: the kick turns velocities by it without changing how long they
    are (see `sandbox.physics.forces.velocity_rotation`).
    """

    @property
    def effect(self) -> Effect:
        """What declares it."""
        ...

    def rate(self, motion: Motion) -> Array:
        """Return ω of each body, counter-clockwise [rad/s]: (..., n), 0 where it does not act."""
        ...


class Given(NamedTuple):
    """What the laws of a level are made of.

    Attributes
    ----------
    level, values
        What says which there are, and its parameters' values.
    names, mass
        (n,), of its bodies; the mass [kg] is that at the start, 0 for those that nothing moves.
    share
        How the masses change.
    step
        How long a kick lasts [s].
    switches
        What events switch: forces that have a name, whole effects, springs.
    """

    level: Level
    values: Values
    names: Sequence[str]
    mass: Array
    share: Share
    step: float
    switches: "Switches" = {}  # noqa: RUF012 (nobody writes to it)

    def row(self, body: str) -> int:
        """Return the row of a body."""
        return self.names.index(body)

    def rows(self, bodies: Sequence[str] | None) -> NDArray[np.intp]:
        """Return the rows of bodies that a law names, of all that move if it names none."""
        return np.flatnonzero(self.mass) if bodies is None else np.array([*map(self.row, bodies)])
