"""How bodies move, as force laws and joints look at it."""

from typing import NamedTuple, Protocol

from sandbox.model.expressions import Array


class Motion(Protocol):
    """What a law may look at: an instant of n bodies, or many, with time in front.

    A `Snapshot` is one; in a step the velocities are the best guess of those at the step.
    """

    @property
    def t(self) -> Array:
        """The time: (...) [s]."""
        ...

    @property
    def position(self) -> Array:
        """(..., n, 2) [m]."""
        ...

    @property
    def angle(self) -> Array:
        """(..., n) [rad]."""
        ...

    @property
    def velocity(self) -> Array:
        """(..., n, 2) [m/s]."""
        ...

    @property
    def angular_velocity(self) -> Array:
        """(..., n) [rad/s]."""
        ...


class Instant(NamedTuple):
    """The motion of n bodies at one time; see `Motion`."""

    t: Array
    position: Array
    angle: Array
    velocity: Array
    angular_velocity: Array
