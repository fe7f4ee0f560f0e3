"""A kick as the ledger books it, and the work that contacts did in it."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.kinematics import point_velocity
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.state.motion import Motion


class Kick(NamedTuple):
    """What a kick is booked with; n bodies.

    Attributes
    ----------
    t, length
        When it was, and how long [s].
    seen
        What the force laws see in it.
    place
        (n, 2), where the bodies were [m].
    mean
        (n, 3), the mean of their velocities before and after [m/s, rad/s].
    inertia
        (n, 3), their masses, masses and moments; 0 for what nothing moves [kg, kg m²].
    """

    t: float
    length: float
    seen: Motion
    place: Array
    mean: Array
    inertia: Array

    def work(self, impulse: Array) -> float:
        """Return the work of impulses: (n, 3) [J]."""
        return float(np.sum(impulse * self.mean))


def pressed(contacts: Contacts, row: int) -> Array:
    """Return the impulse of all contacts on a body: (2,)."""
    given = contacts.impulse[contacts.bodies[:, 1] == row].sum(axis=0)
    taken = contacts.impulse[contacts.bodies[:, 0] == row].sum(axis=0)
    return np.asarray(given - taken)


def completed(contacts: Contacts, impulse: Array) -> Contacts:
    """Return contacts with the whole impulse where a body has but one, not pymunk's share of it.

    Friction that breaks loose within a step is taken down after pymunk has solved it.
    """
    counts = np.bincount(contacts.bodies.ravel(), minlength=len(impulse))
    whole = contacts.impulse.copy()
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows = contacts.bodies[:, side]
        alone = (counts[rows] == 1) & impulse[rows].any(axis=1)
        whole[alone] = sign * impulse[rows[alone], :2]
    return contacts._replace(impulse=whole)


def couples(contacts: Contacts, impulse: Array, place: Array, inertia: Array) -> Array:
    """Return the torque of each contact on its second body, about its middle: (k,) [N m s].

    A side that presses on a side does so more at one end than at the other. How much follows from
    what the bodies lack that turn freely; of contacts that could give it all in several ways each
    gives as little as it can.

    Parameters
    ----------
    contacts, place, inertia
        As for `rubbing`.
    impulse
        (n, 3), of all contacts on each body.
    """
    found = np.zeros(len(contacts.bodies))
    sides = np.flatnonzero(contacts.touches == 2)
    if not len(sides):
        return found
    turning, lack = inertia[:, 2] > 0, impulse[:, 2].copy()
    gives = np.zeros((len(impulse), len(sides)))
    arms = contacts.on_surfaces(_middles(contacts)) - place[contacts.bodies]
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows, arm = contacts.bodies[:, side], arms[:, side]
        across = arm[:, 0] * contacts.impulse[:, 1] - arm[:, 1] * contacts.impulse[:, 0]
        np.subtract.at(lack, rows, sign * across)
        gives[rows[sides], np.arange(len(sides))] = sign
    found[sides] = np.linalg.lstsq(gives[turning], lack[turning], rcond=None)[0]
    return found


def rubbing(
    contacts: Contacts,
    place: Array,
    mean: Array,
    inertia: Array,
    running: Array,
    turned: Array | float = 0.0,
) -> tuple[float, dict[str, float]]:
    """Return the work of friction, and what kinematic bodies and belts put in [J].

    Parameters
    ----------
    contacts
        Those of a kick.
    place, mean, inertia
        As in a `Kick`.
    running
        (n, 2), how fast the bodies' surfaces run [m/s].
    turned
        (k,), the torques of the contacts on their second bodies; see `couples`.
    """
    along = np.stack((-contacts.direction[:, 1], contacts.direction[:, 0]), axis=1)
    friction = np.sum(contacts.impulse * along, axis=1)[:, None] * along
    on_surfaces = contacts.on_surfaces(_middles(contacts))
    slip = np.zeros_like(along)
    work = {"bodies": 0.0, "belt": 0.0}
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows = contacts.bodies[:, side]
        arm, goes = on_surfaces[:, side] - place[rows], mean[rows]
        moves = point_velocity(goes, arm)
        driven = inertia[rows, 0] == 0
        runs = running[rows]
        slip += sign * (moves + runs)
        gives = np.sum(contacts.impulse * moves, axis=1) + turned * goes[:, 2]
        work["bodies"] -= sign * float(np.sum(gives[driven]))
        work["belt"] -= sign * float(np.sum(friction * runs))
    return float(np.sum(friction * slip)), work


def _middles(contacts: Contacts) -> Array:
    """Return the middle of where each pair touches: (k, 2) [m]."""
    second = np.where(contacts.touches == 2, 1, 0)
    both = contacts.points[np.arange(len(second)), second]
    middles: Array = (contacts.points[:, 0] + both) / 2
    return middles
