"""What a force law is."""

from typing import Protocol

from sandbox.model.expressions import Array
from sandbox.physics.motion import Motion


class Law(Protocol):
    """A force, and the energy that it can give back.

    Both work on arrays with any number of leading dimensions, so that the same lines serve a step
    and a whole recorded run. A law touches only the bodies that it acts on.
    """

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
