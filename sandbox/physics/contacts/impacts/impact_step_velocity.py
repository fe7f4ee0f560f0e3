"""The velocity of bodies at a step with an impact.

Normally the velocity at a step is the mean of those half a step before and after. At an impact it
is the velocity right after the impact. It follows from the one half a step later, from which the
acceleration over that time is taken back: that by gravity and the force laws, without the component
that the ground carries.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_kinematics import point_velocity
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts, Integers

NEGLIGIBLE = 1e-3
"""Bodies do not rest if they separate faster than this share of the change of velocity by forces in
a step."""

MAX_HEIGHT = 10
"""The most bodies on top of each other that count as supported by the ground."""


def impacts(
    contacts: Contacts,
    solid: Integers,
    pose: Array,
    before: Array,
    after: Array,
    law_acceleration: Array,
    mass: Array,
    dt: float,
) -> tuple[Integers, Array]:
    """Return the bodies that an impact reached, and their accelerations after it.

    An impact spreads to all bodies in contact with those that it hit. A pair that approaches with
    no more speed than forces add in a step has no impact: a ball may roll from one segment of a
    floor to the next. Friction and strings after the impact are left out: the velocity has an error
    of half a step of their effect.

    `solid`, (s, 2), are pairs of bodies that are welded together. `pose`, (n, 3), are the
    positions of the bodies [m, rad], `before` and `after`, (n, 3), the velocities half a step
    before and after [m/s, rad/s], and `law_acceleration`, (n, 3), the accelerations by gravity and
    force laws [m/s², rad/s²]. `mass`, (n,), is 0 for immovable bodies [kg]; `dt` is the time step
    [s].
    """
    arms = touching(contacts, pose)
    gain, parting, meeting = rates_apart(
        contacts, arms, np.stack((law_acceleration, after, before))
    )
    adds = np.abs(gain) * dt
    hits = meeting < -adds
    hits &= contacts.first[:, None] | (parting > adds)  # a further corner of a touching pair
    struck = np.asarray(hits.any(axis=1))
    if not struck.any():
        return np.flatnonzero(struck), law_acceleration[:0]
    hit = np.flatnonzero(reached(contacts.bodies, struck, mass > 0, linked=solid))
    rests = np.asarray((parting <= NEGLIGIBLE * adds).all(axis=1))
    return hit, _held_up(contacts, rests, law_acceleration, mass == 0)[hit]


def touching(contacts: Contacts, pose: Array) -> Array:
    """Return the lever arms of contact points: (k, 2 points, 2 bodies, 2) [m].

    A single contact point is repeated.
    """
    second = np.where(contacts.touches[:, None] > 1, contacts.points[:, 1], contacts.points[:, 0])
    points = np.stack((contacts.points[:, 0], second), axis=1)
    arms: Array = points[:, :, None] - pose[contacts.bodies][:, None, :, :2]
    return arms


def rates_apart(contacts: Contacts, arms: Array, rate: Array) -> Array:
    """Return the rates of separation at the points of k contacts: (..., k, 2).

    `arms`, (k, 2, 2, 2), are the lever arms from `touching` [m]; `rate`, (..., n, 3), are the
    velocities, or accelerations, of the bodies [m/s, rad/s].
    """
    point_velocities = point_velocity(rate[..., contacts.bodies, :][..., None, :, :], arms)
    apart = point_velocities[..., 1, :] - point_velocities[..., 0, :]
    parting: Array = np.sum(apart * contacts.direction[:, None], axis=-1)
    return parting


def reached(
    bodies: Integers, struck: Booleans, moving: Booleans, linked: Integers = NO_CONTACTS.bodies
) -> Booleans:
    """Return the bodies connected to struck pairs, directly or through movable bodies: (n,).

    `bodies`, (k, 2), are the pairs that touch, and `struck`, (k,), tells which of them are struck;
    `moving`, (n,), tells which bodies can move. `linked`, (m, 2), are pairs that are connected
    without a contact.
    """
    pairs = np.concatenate((bodies, linked))
    pairs = pairs[moving[pairs].all(axis=1)]
    touched = np.zeros_like(moving)
    touched[bodies[struck]] = True
    touched &= moving
    count = 0
    while (now := int(touched.sum())) > count:
        count = now
        touched[pairs[touched[pairs].any(axis=1)]] = True
    return touched


def _held_up(
    contacts: Contacts, rests: Booleans, law_acceleration: Array, fixed: Booleans
) -> Array:
    """Return the accelerations less the components that the ground supports, also indirectly."""
    body, other = contacts.bodies[rests].ravel(), contacts.bodies[rests][:, ::-1].ravel()
    outwards = np.stack([-contacts.direction[rests], contacts.direction[rests]], axis=1)
    outwards = outwards.reshape(-1, 2)
    acceleration, holds = law_acceleration.copy(), fixed.copy()
    least = -1e-12 * np.abs(law_acceleration).max()
    for _ in range(MAX_HEIGHT):
        away = np.einsum("ij,ij->i", acceleration[body, :2], outwards)
        away[fixed[body] | ~holds[other]] = 0.0
        most = np.zeros(len(law_acceleration))
        np.minimum.at(most, body, away)
        pressing = np.flatnonzero((away < least) & (away == most[body]))
        if not pressing.size:
            break
        pressing = pressing[np.unique(body[pressing], return_index=True)[1]]  # one contact a body
        acceleration[body[pressing], :2] -= away[pressing, None] * outwards[pressing]
        holds[body[pressing]] = True
    return acceleration
