"""The phases of slipping within a step, and the work of friction in each."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_kinematics import pair_jacobian
from sandbox.physics.contacts.impacts.contact_work import contact_friction_work
from sandbox.physics.engine.space_arrays import Contacts, Integers
from sandbox.physics.state.motion import momentum

ROUNDING = 1e-12
"""A slip counts as zero if it is slower than this share of the speeds of the two surfaces."""

FAINT = 1e-9
"""It also counts as zero below this share of the change of these speeds in a step."""


class Slips(NamedTuple):
    """The slips of k contacts of n bodies, along their surfaces."""

    bodies: Integers
    """(k, 2), the two bodies of each contact."""
    jacobian: Array
    """(k, 2, 3), the Jacobian of the slip, for the velocities of the two bodies."""
    belt_slip: Array
    """(k,), the slip due to running surfaces, such as belts [m/s]."""
    distance: Array
    """(k,), the approximate distance from the origin [m]."""

    @classmethod
    def of(cls, contacts: Contacts, pose: Array, running: Array) -> "Slips":
        """Return the slips of a kick's contacts.

        `pose`, (n, 3), are the positions of the bodies [m, rad], and `running`, (n, 2), the
        velocities of their running surfaces [m/s].
        """
        bodies, (x, y) = contacts.bodies, contacts.direction.T
        arm = contacts.on_surfaces(contacts.points[:, 0]) - pose[bodies, :2]
        slip_jacobian = pair_jacobian(arm, np.stack((-y, x), axis=1))
        runs = np.einsum("kbc,kbc->k", slip_jacobian[..., :2], running[bodies])
        return cls(bodies, slip_jacobian, runs, np.abs(contacts.points[:, 0]).sum(axis=1))

    def change(self, acceleration: Array) -> Array:
        """Return the rates of change of the slips under accelerations (n, 3): (k,) [m/s²]."""
        return np.asarray(np.einsum("kbc,kbc->k", self.jacobian, acceleration[self.bodies]))

    def speed(self, velocity: Array) -> Array:
        """Return the slip velocity of each second body relative to the first: (k,) [m/s]."""
        return self.change(velocity) + self.belt_slip

    def sense(self, velocity: Array, adds: Array, blur: float) -> Array:
        """Return the direction of each slip, 1 or −1, or 0 if there is none: (k,).

        `velocity`, (n, 3), is that of the bodies, and `adds`, (n, 3), its approximate change in a
        step [m/s, rad/s]; `blur` is a further uncertainty of the slips, per metre from the
        origin [1/s].
        """
        speed = self.speed(velocity)
        sizes = np.abs(velocity) + np.abs(adds) * (FAINT / ROUNDING)
        sizes[:, :2] = sizes[:, :2].sum(axis=1, keepdims=True)  # in any direction
        least_speed = ROUNDING * (self._sizes(sizes) + np.abs(self.belt_slip))
        return np.where(np.abs(speed) > least_speed + blur * self.distance, np.sign(speed), 0.0)

    def _sizes(self, sizes: Array) -> Array:
        return np.asarray(np.einsum("kbc,kbc->k", np.abs(self.jacobian), sizes[self.bodies]))


class Phase(NamedTuple):
    """A part of a drift in which the accelerations of n bodies are constant."""

    duration: float
    """Its duration [s]."""
    pose: Array
    """(n, 3), the positions at its start [m, rad]."""
    velocity: Array
    """(n, 3), the velocities at its start [m/s, rad/s]."""
    acceleration: Array
    """(n, 3), the accelerations in it [m/s², rad/s²]."""
    forces: Contacts
    """The contacts, with forces in place of impulses."""

    def at(self, time: float) -> tuple[Array, Array]:
        """Return positions and velocities at a time after its start [s]."""
        velocity = self.velocity + self.acceleration * time
        return self.pose + (self.velocity + velocity) * (time / 2), velocity


class SlipEntries(NamedTuple):
    """The energy and momentum that the end of slipping within a drift adds to the books; n bodies.

    The books assume that the kick before the drift acts until its middle, and the kick after it
    from there on.
    """

    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the kick after the drift [m/s, rad/s]."""
    friction_work: float
    """The work of friction beyond that in the halves of the two kicks [J]."""
    belt_works: dict[str, float]
    """The same of belts and kinematic bodies, by account [J]."""
    extra_displacement: Array
    """(n, 3), the displacements beyond those in the halves of the two kicks [m, rad]."""
    reading_shift: float
    """The change of the energy read in the middle of the drift that is only due to the change of
    acceleration [J]: on the parabola, the energy due to a force F is higher by F a dt²/8 than in
    the middle of the chord."""
    momentum: Array
    """(3,), the momentum and angular momentum beyond the two halves [kg m/s, kg m²/s]."""


def slip_entries(
    phases: Sequence[Phase], inertia: Array, law_acceleration: Array, running: Array, dt: float
) -> SlipEntries:
    """Return the entries for the books from a drift of several phases, of length dt [s].

    Bodies that are not affected by an end of slipping have constant accelerations. `inertia`,
    (n, 3), has masses, masses and moments [kg, kg m²]; `law_acceleration`, (n, 3), are the
    accelerations by gravity and force laws [m/s², rad/s²], and `running`, (n, 2), the velocities of
    the bodies' running surfaces [m/s].
    """
    first, last, half = phases[0], phases[-1], dt / 2
    pose, velocity = last.at(last.duration)
    begun = velocity - last.acceleration * half
    halves = (
        first._replace(duration=half),
        last._replace(duration=half, pose=pose - velocity * half, velocity=begun),
    )
    (friction_work, works), added = (
        friction_work_beyond(phases, halves, inertia, running),
        np.zeros(3),
    )
    for part in phases:
        middle = part.pose + part.velocity * (part.duration / 2)
        added += momentum(inertia * part.acceleration * part.duration, middle)
    added -= momentum(inertia * first.acceleration * half, first.pose)
    added -= momentum(inertia * last.acceleration * half, pose)
    displacement = sum(
        part.velocity * half + part.acceleration * (half * half / 2) for part in halves
    )
    change = first.acceleration - last.acceleration
    lifted = float(np.sum(inertia * law_acceleration * change)) * half * half / 2
    return SlipEntries(begun, friction_work, works, pose - first.pose - displacement, lifted, added)


def friction_work_beyond(
    phases: Sequence[Phase], halves: Sequence[Phase], inertia: Array, running: Array
) -> tuple[float, dict[str, float]]:
    """Return the work of friction in phases beyond that in the halves of two kicks [J].

    Also that of belts and kinematic bodies; see `slip_entries`.
    """
    friction_work, works = 0.0, {"bodies": 0.0, "belt": 0.0}
    for sign, parts in ((1, phases), (-1, halves)):
        for part in parts:
            mean = part.velocity + part.acceleration * (part.duration / 2)
            forces = part.forces.scaled(part.duration)
            work, drives = contact_friction_work(forces, part.pose[:, :2], mean, inertia, running)
            friction_work += sign * work
            works = {name: works[name] + sign * drives[name] for name in works}
    return friction_work, works
