"""Which contacts slip at a step, and which stop slipping before the next."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch, Booleans, Contacts
from sandbox.physics.events.restart_kick import Onwards
from sandbox.physics.events.slip_phases import Slips

WEAKER = 1e-6
"""Friction below its limit by more than this share no longer slips."""


class Seen(NamedTuple):
    """The contacts of a kick of n bodies; k of them.

    Attributes
    ----------
    place
        (n, 3), where the bodies are [m, rad].
    slips, sense
        How the contacts slip, and which way.
    ends
        (k,), whose slip ends in the drift after the kick.
    weakened
        (k,), whose friction pymunk has weakened for that already.
    steps
        How many steps it is to the first end.
    """

    place: Array
    slips: Slips
    sense: Array
    ends: Booleans
    weakened: Booleans
    steps: float


class Lookout:
    """Sees whose slipping ends; n bodies, k contacts.

    Parameters
    ----------
    batch
        Reads the bodies.
    named
        (n,), whose slipping matters.
    coefficients
        (n, n), of the friction of each pair that slips.
    onwards
        Distinguishes slips from rounding.
    dt
        The time step [s].
    """

    def __init__(
        self, batch: Batch, named: Booleans, coefficients: Array, onwards: Onwards, dt: float
    ) -> None:
        self._batch, self._named, self._coefficients = batch, named, coefficients
        self._onwards, self._dt = onwards, dt

    def see(self, came: Array, velocity: Array, acceleration: Array) -> Seen:
        """Return which contacts slip at the step, and no longer at the next.

        Which way they slip is told by how they came to the step: the end of one slip, which pymunk
        takes for one of the whole kick, makes others slip after it.
        """
        contacts, place = self._batch.contacts(), self._batch.state()[:, :3]
        slips, adds = Slips.of(contacts, place, self._onwards.running), acceleration * self._dt
        sense = self._onwards.sense(slips, contacts, came, adds)
        named = (sense != 0) & self._named[slips.bodies].any(axis=1)
        most = self._coefficients[contacts.bodies[:, 0], contacts.bodies[:, 1]] * contacts.normal
        weakened = named & (contacts.friction < most * (1 - WEAKER))
        ends = weakened | self.ends(slips, sense, contacts, velocity + adds, adds)
        if ends.any():
            half_on = self._onwards.sense(slips, contacts, velocity + adds / 2, adds)
            weakened |= ends & (half_on != sense)
        steps = self.wait(slips, sense, velocity, adds)
        return Seen(place, slips, sense, ends, weakened, float(steps.min()))

    def ends(
        self, slips: Slips, sense: Array, contacts: Contacts, velocity: Array, adds: Array
    ) -> Booleans:
        """Return which contacts of named bodies no longer slip when they are as fast: (k,)."""
        later = self._onwards.sense(slips, contacts, velocity, adds)
        return (sense != 0) & self._named[slips.bodies].any(axis=1) & (later != sense)

    def wait(self, slips: Slips, sense: Array, velocity: Array, acceleration: Array) -> Array:
        """Return how long each contact of named bodies slips on, for ever if it does: (k,)."""
        speed, change = sense * slips.speed(velocity), sense * slips.change(acceleration)
        slows = (change < 0) & self._named[slips.bodies].any(axis=1)
        wait = np.full(len(sense), np.inf)
        np.divide(speed, -change, out=wait, where=slows)
        return np.maximum(wait, 0.0)
