"""A kick as the ledger books it, and the work of contacts in it."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_kinematics import point_velocity
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.state.motion import Motion, Reading


class KickRecord(NamedTuple):
    """The data of a kick for the books; n bodies.

    `t` and `length` are its time and length [s], and `law_motion` is the motion that the force laws
    see in it. `positions`, (n, 2), are the positions of the bodies [m], `mean_velocity`, (n, 3), is
    the mean of their velocities before and after [m/s, rad/s], and `inertia`, (n, 3), has their
    masses, masses and moments; 0 for immovable bodies [kg, kg m²]. `turning_acceleration`, (n, 2),
    is by forces that turn velocities [m/s²]; None without such forces.
    """

    t: float
    length: float
    law_motion: Motion
    positions: Array
    mean_velocity: Array
    inertia: Array
    turning_acceleration: Array | None = None

    def part(self, length: float, mean_velocity: Array, *, first: bool) -> "KickRecord":
        """Return a part of it; whatever the kick makes up for belongs to the `first`."""
        motion = self.law_motion
        if isinstance(motion, Reading) and motion.path:
            motion = motion.weighted(self.length / length if first else 0.0)
        return self._replace(length=length, mean_velocity=mean_velocity, law_motion=motion)

    def work(self, impulse: Array) -> float:
        """Return the work of impulses: (n, 3) [J]."""
        return float(np.sum(impulse * self.mean_velocity))


def normal_impulse(contacts: Contacts, row: int) -> Array:
    """Return the impulse of all contacts on a body: (2,)."""
    impulse = contacts.impulse[contacts.bodies[:, 1] == row].sum(axis=0)
    taken = contacts.impulse[contacts.bodies[:, 0] == row].sum(axis=0)
    return np.asarray(impulse - taken)


def completed(contacts: Contacts, impulse: Array) -> Contacts:
    """Return contacts with the total impulse for bodies that have only one contact.

    pymunk's own value differs if friction breaks loose within a step, as it is then reduced after
    the solve.
    """
    counts = np.bincount(contacts.bodies.ravel(), minlength=len(impulse))
    whole = contacts.impulse.copy()
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows = contacts.bodies[:, side]
        alone = (counts[rows] == 1) & impulse[rows].any(axis=1)
        whole[alone] = sign * impulse[rows[alone], :2]
    return contacts._replace(impulse=whole)


def contact_torques(contacts: Contacts, impulse: Array, positions: Array, inertia: Array) -> Array:
    """Return the angular impulse of contacts on their second bodies, about their middle: (k,).

    The pressure of one side on another is larger at one end. The difference follows from the
    missing angular impulse [N m s] of the bodies that rotate freely; if it is not unique, the
    least-norm solution is taken.

    `impulse`, (n, 3), is that of all contacts on each body; the other arguments are as for
    `contact_friction_work`.
    """
    found = np.zeros(len(contacts.bodies))
    sides = np.flatnonzero(contacts.touches == 2)
    if not len(sides):
        return found
    turning, lack = inertia[:, 2] > 0, impulse[:, 2].copy()
    gives = np.zeros((len(impulse), len(sides)))
    arms = contacts.on_surfaces(_middles(contacts)) - positions[contacts.bodies]
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows, arm = contacts.bodies[:, side], arms[:, side]
        across = arm[:, 0] * contacts.impulse[:, 1] - arm[:, 1] * contacts.impulse[:, 0]
        np.subtract.at(lack, rows, sign * across)
        gives[rows[sides], np.arange(len(sides))] = sign
    found[sides] = np.linalg.lstsq(gives[turning], lack[turning], rcond=None)[0]
    return found


def contact_friction_work(
    contacts: Contacts,
    positions: Array,
    mean_velocity: Array,
    inertia: Array,
    running: Array,
    torques: Array | float = 0.0,
) -> tuple[float, dict[str, float]]:
    """Return the work of friction, and the energy from kinematic bodies and belts [J].

    `contacts` are those of a kick, and `positions`, `mean_velocity` and `inertia` are as in a
    `KickRecord`. `running`, (n, 2), are the velocities of the bodies' running surfaces [m/s];
    `torques`, (k,), are the angular impulses of the contacts on their second bodies, see
    `contact_torques`.
    """
    along = np.stack((-contacts.direction[:, 1], contacts.direction[:, 0]), axis=1)
    friction = np.sum(contacts.impulse * along, axis=1)[:, None] * along
    on_surfaces = contacts.on_surfaces(_middles(contacts))
    slip = np.zeros_like(along)
    work = {"bodies": 0.0, "belt": 0.0}
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows = contacts.bodies[:, side]
        arm, velocity = on_surfaces[:, side] - positions[rows], mean_velocity[rows]
        point_velocities = point_velocity(velocity, arm)
        is_kinematic = inertia[rows, 0] == 0
        runs = running[rows]
        slip += sign * (point_velocities + runs)
        gives = np.sum(contacts.impulse * point_velocities, axis=1) + torques * velocity[:, 2]
        work["bodies"] -= sign * float(np.sum(gives[is_kinematic]))
        work["belt"] -= sign * float(np.sum(friction * runs))
    return float(np.sum(friction * slip)), work


def _middles(contacts: Contacts) -> Array:
    """Return the middle of each contact: (k, 2) [m]."""
    second = np.where(contacts.touches == 2, 1, 0)
    both = contacts.points[np.arange(len(second)), second]
    middles: Array = (contacts.points[:, 0] + both) / 2
    return middles
