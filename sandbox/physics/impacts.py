"""The velocity at a step in which bodies hit each other.

Elsewhere the velocity at a step is the mean of those half a step before and after. An impact has no
such mean: what counts is the velocity right after it, from which the body then goes on for half a
step. So that half step is taken back, with the acceleration of what goes on: gravity and the force
laws, less what a wall or floor under the body holds up.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.batch import Contacts, Integers

NEGLIGIBLE = 1e-3
"""Bodies part if they do so with more than this share of what their pull adds in a step."""


def impacts(
    contacts: Contacts, before: Array, after: Array, pull: Array, mass: Array, dt: float
) -> tuple[Integers, Array]:
    """Return which bodies were hit, and their accelerations from there on.

    A pair that meets with no more speed than its pull gives it in a step is not hit but met: a ball
    that rolls from one segment of a floor to the next. What others than static and kinematic bodies
    hold up, and friction, is left out: the velocity is then off by half a step of it.

    Parameters
    ----------
    contacts
        Of the step.
    before, after
        (n, 3), the velocities half a step before and after [m/s, rad/s].
    pull
        (n, 3), the accelerations by gravity and force laws [m/s², rad/s²].
    mass
        (n,), 0 for bodies that nothing moves [kg].
    dt
        The time step [s].
    """
    adds = np.abs(_parting(contacts, pull)) * dt
    struck = contacts.first & (_parting(contacts, before) < -adds)
    hit = np.unique(contacts.bodies[struck])
    if not hit.size:
        return hit, pull[hit]
    rests = _parting(contacts, after) <= NEGLIGIBLE * adds
    onwards = pull.copy()
    for (a, b), direction in zip(contacts.bodies[rests], contacts.direction[rests], strict=True):
        if mass[b] == 0:
            _hold_up(onwards[a, :2], -direction)
        elif mass[a] == 0:
            _hold_up(onwards[b, :2], direction)
    return hit, onwards[hit]


def _parting(contacts: Contacts, rate: Array) -> Array:
    """Return how fast each pair's velocities, or accelerations, take it apart: (k,)."""
    a, b = contacts.bodies.T
    difference: Array = np.sum((rate[b] - rate[a])[:, :2] * contacts.direction, axis=1)
    return difference


def _hold_up(acceleration: Array, outwards: Array) -> None:
    """Take from an acceleration what a surface does not let through; (2,), changed in place."""
    acceleration -= outwards * min(float(acceleration @ outwards), 0.0)
