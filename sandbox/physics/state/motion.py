"""The motion of bodies, as read by force laws and joints."""

from typing import NamedTuple, Protocol

import numpy as np

from sandbox.model.expressions import Array


class Motion(Protocol):
    """The motion of n bodies at one instant, or at many along leading axes, as input of laws.

    A `Snapshot` is one. Within a step, the velocities are the best estimate of those at the step.
    """

    @property
    def t(self) -> Array:
        """The time: (...) [s]."""

    @property
    def position(self) -> Array:
        """The positions: (..., n, 2) [m]."""

    @property
    def angle(self) -> Array:
        """The angles: (..., n) [rad]."""

    @property
    def velocity(self) -> Array:
        """The velocities: (..., n, 2) [m/s]."""

    @property
    def angular_velocity(self) -> Array:
        """The angular velocities: (..., n) [rad/s]."""


class Instant(NamedTuple):
    """The motion of n bodies at one time; see `Motion`."""

    t: Array
    position: Array
    angle: Array
    velocity: Array
    angular_velocity: Array

    @classmethod
    def of(cls, motion: Motion) -> "Instant":
        """Return the fields of a motion as an `Instant`, which can be changed by `_replace`."""
        return cls(*(getattr(motion, field) for field in cls._fields))

    @classmethod
    def at(cls, t: float, pose: Array, velocity: Array) -> "Instant":
        """Return the motion at a time [s], from two arrays (..., n, 3) [m, rad, m/s, rad/s]."""
        linear, angular = velocity[..., :2], velocity[..., 2]
        return cls(np.asarray(t), pose[..., :2], pose[..., 2], linear, angular)


class Reading:
    """The motion of n bodies, as views of one array; see `Motion`.

    `state`, (n, 6), has x, y, angle, and their rates of change [m, rad, m/s, rad/s] at a time
    t [s]. `path` are motions with other velocities, and their weights, which add up to 0. They
    say what forces that depend on velocities did differently where impacts changed these in the
    last kick, or since; this kick makes up for that at its beginning.
    """

    __slots__ = ("path", "state", "t")

    def __init__(self, t: Array, state: Array) -> None:
        self.t, self.state = t, state
        self.path: tuple[tuple[float, Reading], ...] = ()

    def weighted(self, factor: float) -> "Reading":
        """Return it with the weights of its path multiplied by a factor; 0 leaves no path."""
        reading = Reading(self.t, self.state)
        if factor:
            reading.path = tuple((factor * weight, motion) for weight, motion in self.path)
        return reading

    @property
    def position(self) -> Array:
        """The positions: (n, 2) [m]."""
        return self.state[:, :2]

    @property
    def angle(self) -> Array:
        """The angles: (n,) [rad]."""
        return self.state[:, 2]

    @property
    def velocity(self) -> Array:
        """The velocities: (n, 2) [m/s]."""
        return self.state[:, 3:5]

    @property
    def angular_velocity(self) -> Array:
        """The angular velocities: (n,) [rad/s]."""
        return self.state[:, 5]


def momentum(momenta: Array, position: Array) -> Array:
    """Return the total momentum of n bodies, and the angular momentum about the origin: (3,).

    `momenta`, (n, 3), is each body's momentum, and angular momentum about its own centre; or
    impulses. `position` are the positions, (n, 2) or, with angles, (n, 3) [m].
    """
    x, y = position.T[:2]
    moment = x * momenta[:, 1] - y * momenta[:, 0] + momenta[:, 2]
    return np.array([*momenta[:, :2].sum(axis=0), moment.sum()])


def kinetic_energy(mass: Array, moment: Array, motion: Motion) -> Array:
    """Return the kinetic energy of n bodies [J]: (..., n).

    `mass` and `moment`, (..., n), are 0 for bodies that do not move or turn [kg, kg m²].
    """
    square = np.sum(motion.velocity * motion.velocity, axis=-1)
    return np.asarray((mass * square + moment * motion.angular_velocity**2) / 2)
