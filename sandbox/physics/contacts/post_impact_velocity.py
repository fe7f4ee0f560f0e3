"""The velocity of bodies at a step in which they collide.

Elsewhere the velocity at a step is the mean of those half a step before and after. An impact has no
such mean: what counts is the velocity right after it, from which the body then goes on for half a
step. So that half step is taken back, with the acceleration of what goes on: gravity and the force
laws, less what the ground under the body holds up.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.kinematics import point_velocity
from sandbox.physics.engine.batch import NO_CONTACTS, Booleans, Contacts, Integers

NEGLIGIBLE = 1e-3
"""Bodies part if they do so with more than this share of what forces add in a step."""

MAX_HEIGHT = 10
"""How many bodies on top of each other are known to be held up by the ground."""


def impacts(
    contacts: Contacts,
    solid: Integers,
    place: Array,
    before: Array,
    after: Array,
    smooth: Array,
    mass: Array,
    dt: float,
) -> tuple[Integers, Array]:
    """Return which bodies an impact reached, and their accelerations from there on.

    An impact goes on to everything that touches what it hit. A pair that meets with no more speed
    than forces give it in a step is not hit but met: a ball that rolls from one segment of a
    floor to the next. What friction and strings do from there on is left out: a velocity is off by
    half a step of it.

    Parameters
    ----------
    contacts
        Of the step.
    solid
        (s, 2), pairs of bodies that are parts of one solid.
    place
        (n, 3), where the bodies are [m, rad].
    before, after
        (n, 3), the velocities half a step before and after [m/s, rad/s].
    smooth
        (n, 3), the accelerations by gravity and force laws [m/s², rad/s²].
    mass
        (n,), 0 for bodies that nothing moves [kg].
    dt
        The time step [s].
    """
    arms = touching(contacts, place)
    gain, parting, meeting = rates_apart(contacts, arms, np.stack((smooth, after, before)))
    adds = np.abs(gain) * dt
    hits = meeting < -adds
    hits &= contacts.first[:, None] | (parting > adds)  # the next corner of what touches already
    struck = np.asarray(hits.any(axis=1))
    if not struck.any():
        return np.flatnonzero(struck), smooth[:0]
    hit = np.flatnonzero(reached(contacts.bodies, struck, mass > 0, linked=solid))
    rests = np.asarray((parting <= NEGLIGIBLE * adds).all(axis=1))
    return hit, _held_up(contacts, rests, smooth, mass == 0)[hit]


def touching(contacts: Contacts, place: Array) -> Array:
    """Return where pairs touch, from the centre of each: (k, 2 points, 2 bodies, 2) [m].

    Where they touch at one point only, that counts twice.
    """
    second = np.where(contacts.touches[:, None] > 1, contacts.points[:, 1], contacts.points[:, 0])
    points = np.stack((contacts.points[:, 0], second), axis=1)
    arms: Array = points[:, :, None] - place[contacts.bodies][:, None, :, :2]
    return arms


def rates_apart(contacts: Contacts, arms: Array, rate: Array) -> Array:
    """Return how fast velocities, or accelerations, take pairs apart where they touch: (..., k, 2).

    Parameters
    ----------
    contacts
        k pairs.
    arms
        (k, 2, 2, 2), as `touching` tells them [m].
    rate
        (..., n, 3), of the bodies [m/s, rad/s].
    """
    moves = point_velocity(rate[..., contacts.bodies, :][..., None, :, :], arms)
    apart = moves[..., 1, :] - moves[..., 0, :]
    parting: Array = np.sum(apart * contacts.direction[:, None], axis=-1)
    return parting


def reached(
    bodies: Integers, struck: Booleans, moving: Booleans, linked: Integers = NO_CONTACTS.bodies
) -> Booleans:
    """Return which bodies touch, directly or through others that move, what was struck: (n,).

    Parameters
    ----------
    bodies
        (k, 2), the pairs that touch.
    struck
        (k,), which of them are struck.
    moving
        (n,), which bodies can move.
    linked
        (m, 2), pairs that hang together, whether they touch or not.
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


def _held_up(contacts: Contacts, rests: Booleans, smooth: Array, fixed: Booleans) -> Array:
    """Return the accelerations less what presses on the ground, or on what the ground holds up."""
    body, other = contacts.bodies[rests].ravel(), contacts.bodies[rests][:, ::-1].ravel()
    outwards = np.stack([-contacts.direction[rests], contacts.direction[rests]], axis=1)
    outwards = outwards.reshape(-1, 2)
    acceleration, holds = smooth.copy(), fixed.copy()
    least = -1e-12 * np.abs(smooth).max()
    for _ in range(MAX_HEIGHT):
        away = np.einsum("ij,ij->i", acceleration[body, :2], outwards)
        away[fixed[body] | ~holds[other]] = 0.0
        most = np.zeros(len(smooth))
        np.minimum.at(most, body, away)
        pressed = np.flatnonzero((away < least) & (away == most[body]))
        if not pressed.size:
            break
        pressed = pressed[np.unique(body[pressed], return_index=True)[1]]  # one contact a body
        acceleration[body[pressed], :2] -= away[pressed, None] * outwards[pressed]
        holds[body[pressed]] = True
    return acceleration
