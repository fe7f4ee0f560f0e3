"""The phases of slipping within a step, and the work of friction in each."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.contact_work import rubbing
from sandbox.physics.contacts.kinematics import pair_jacobian
from sandbox.physics.engine.batch import Contacts, Integers
from sandbox.physics.state.motion import momentum

ROUNDING = 1e-12
"""A slip slower than this share of the speeds whose difference it is counts as none;"""

FAINT = 1e-9
"""so does one slower than this share of what a step adds to them."""


class Slips(NamedTuple):
    """The contacts of n bodies, seen along their surfaces; k of them.

    Attributes
    ----------
    bodies
        (k, 2), who touches whom.
    way
        (k, 2, 3), how much of the two bodies' velocities is slip.
    runs
        (k,), how fast the surfaces slip by themselves, as those of belts do [m/s].
    far
        (k,), about how far from the origin that is [m].
    """

    bodies: Integers
    way: Array
    runs: Array
    far: Array

    @classmethod
    def of(cls, contacts: Contacts, place: Array, running: Array) -> "Slips":
        """Return the slips of contacts.

        Parameters
        ----------
        contacts
            Those of a kick.
        place
            (n, 3), where the bodies are [m, rad].
        running
            (n, 2), how fast their surfaces run [m/s].
        """
        bodies, (x, y) = contacts.bodies, contacts.direction.T
        arm = contacts.on_surfaces(contacts.points[:, 0]) - place[bodies, :2]
        way = pair_jacobian(arm, np.stack((-y, x), axis=1))
        runs = np.einsum("kbc,kbc->k", way[..., :2], running[bodies])
        return cls(bodies, way, runs, np.abs(contacts.points[:, 0]).sum(axis=1))

    def change(self, acceleration: Array) -> Array:
        """Return how fast the slips change with accelerations (n, 3): (k,) [m/s²]."""
        return np.asarray(np.einsum("kbc,kbc->k", self.way, acceleration[self.bodies]))

    def speed(self, velocity: Array) -> Array:
        """Return how fast the second of each two bodies slips over the first: (k,) [m/s]."""
        return self.change(velocity) + self.runs

    def sense(self, velocity: Array, adds: Array, blur: float) -> Array:
        """Return which way each slips, 1 or −1, or 0 if it does not: (k,).

        Parameters
        ----------
        velocity
            (n, 3) [m/s, rad/s].
        adds
            (n, 3), about what a step may change them by [m/s, rad/s].
        blur
            What else they are uncertain by, a metre from the origin [1/s].
        """
        speed = self.speed(velocity)
        sizes = np.abs(velocity) + np.abs(adds) * (FAINT / ROUNDING)
        sizes[:, :2] = sizes[:, :2].sum(axis=1, keepdims=True)  # whatever their direction
        known = ROUNDING * (self._sizes(sizes) + np.abs(self.runs))
        return np.where(np.abs(speed) > known + blur * self.far, np.sign(speed), 0.0)

    def _sizes(self, sizes: Array) -> Array:
        return np.asarray(np.einsum("kbc,kbc->k", np.abs(self.way), sizes[self.bodies]))


class Phase(NamedTuple):
    """A part of a drift in which the accelerations of n bodies stay as they are.

    Attributes
    ----------
    lasts
        How long it is [s].
    place, velocity, acceleration
        (n, 3), places and velocities at its beginning, and the accelerations in it.
    forces
        What contacts do in it, impulses standing for forces.
    """

    lasts: float
    place: Array
    velocity: Array
    acceleration: Array
    forces: Contacts

    def at(self, time: float) -> tuple[Array, Array]:
        """Return positions and velocities some time after its beginning [s]."""
        velocity = self.velocity + self.acceleration * time
        return self.place + (self.velocity + velocity) * (time / 2), velocity


class Stop(NamedTuple):
    """What books kept in the middle of a drift must know of slipping that ended in it; n bodies.

    They take the kick before the drift to go on for half of it, and that after it to begin there.

    Attributes
    ----------
    begun
        (n, 3), the velocities that the kick after the drift begins with [m/s, rad/s].
    rubbed, works
        The work of friction beyond that of the halves of the two kicks; and of belts, and of
        kinematic bodies [J].
    way
        (n, 3), how much further the bodies went than the halves of the two kicks have them go
        [m, rad].
    lifted
        How much more energy they have in the middle of the drift for nothing but another
        acceleration [J]: along a parabola there is a force's F a dt²/8 more than in the middle of
        the chord.
    given
        The momentum, and the angular momentum, beyond what the halves give: (3,)
        [kg m/s, kg m²/s].
    """

    begun: Array
    rubbed: float
    works: dict[str, float]
    way: Array
    lifted: float
    given: Array


def booked(
    phases: Sequence[Phase], inertia: Array, smooth: Array, running: Array, dt: float
) -> Stop:
    """Return what books must know of a drift of several phases.

    Parameters
    ----------
    phases
        Its parts; what is not touched by the ends between them has the same in all.
    inertia
        (n, 3), masses, masses and moments [kg, kg m²].
    smooth
        (n, 3), the accelerations by gravity and force laws [m/s², rad/s²].
    running
        (n, 2), how fast the bodies' surfaces run [m/s].
    dt
        How long it is [s].
    """
    first, last, half = phases[0], phases[-1], dt / 2
    place, velocity = last.at(last.lasts)
    begun = velocity - last.acceleration * half
    halves = (
        first._replace(lasts=half),
        last._replace(lasts=half, place=place - velocity * half, velocity=begun),
    )
    rubbed, works, given = 0.0, {"bodies": 0.0, "belt": 0.0}, np.zeros(3)
    for sign, parts in ((1, phases), (-1, halves)):
        for part in parts:
            mean = part.velocity + part.acceleration * (part.lasts / 2)
            forces = part.forces.times(part.lasts)
            work, drives = rubbing(forces, part.place[:, :2], mean, inertia, running)
            rubbed += sign * work
            works = {name: works[name] + sign * drives[name] for name in works}
    for part in phases:
        middle = part.place + part.velocity * (part.lasts / 2)
        given += momentum(inertia * part.acceleration * part.lasts, middle)
    given -= momentum(inertia * first.acceleration * half, first.place)
    given -= momentum(inertia * last.acceleration * half, place)
    ways = sum(part.velocity * half + part.acceleration * (half * half / 2) for part in halves)
    change = first.acceleration - last.acceleration
    lifted = float(np.sum(inertia * smooth * change)) * half * half / 2
    return Stop(begun, rubbed, works, place - first.place - ways, lifted, given)
