"""What a force law is."""

from typing import Literal, Protocol

from sandbox.model.expressions import Array
from sandbox.physics.state.motion import Motion

Book = Literal["potential", "loss", "work"]
"""Where the energy is that a force takes: stored, lost, or put in from outside."""


class Law(Protocol):
    """A force, and the energy that it can give back.

    Both work on arrays with any number of leading dimensions, so that the same lines serve a step
    and a whole recorded run. A law touches only the bodies that it acts on.
    """

    @property
    def effect(self) -> str:
        """The name of what declares it: an effect, or `spring`."""
        ...

    @property
    def book(self) -> Book:
        """Where the ledger of energies finds what the force takes."""
        ...

    @property
    def needs_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        ...

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add force and torque on each body [N, N m] to an array: (..., n, 3)."""
        ...

    def potential_energy(self, motion: Motion) -> Array:
        """Return the potential energy of each body [J]: (..., n)."""
        ...
