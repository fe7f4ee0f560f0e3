"""Detection of contacts that slip at a step and stop slipping before the next."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Batch, Booleans, Contacts
from sandbox.physics.events.post_event_accelerations import ContinuationSolver
from sandbox.physics.events.slip_phases import Slips

WEAKER = 1e-6
"""A contact whose friction is below its limit by more than this share no longer slips."""


class SlipState(NamedTuple):
    """The k contacts of a kick of n bodies."""

    pose: Array
    """(n, 3), the positions of the bodies [m, rad]."""
    slips: Slips
    """The slips of the contacts."""
    sense: Array
    """(k,), the directions of the slips: 1, −1, or 0 if there is none."""
    ends: Booleans
    """(k,), the contacts whose slip ends in the drift after the kick."""
    weakened: Booleans
    """(k,), the contacts whose friction pymunk has already reduced for that."""
    steps: float
    """The number of steps until the first end."""


class SlipDetector:
    """Detects the contacts whose slip ends; n bodies, k contacts.

    `named`, (n,), are the bodies whose slipping is located, and `coefficients`, (n, n), those of
    kinetic friction of each pair. `continuation` distinguishes slip from rounding; `dt` is the time
    step [s].
    """

    def __init__(
        self,
        batch: Batch,
        named: Booleans,
        coefficients: Array,
        continuation: ContinuationSolver,
        dt: float,
    ) -> None:
        self._batch, self._named, self._coefficients = batch, named, coefficients
        self._continuation, self._dt = continuation, dt

    def detect(self, previous_velocity: Array, velocity: Array, acceleration: Array) -> SlipState:
        """Return which contacts slip at the step, and which no longer do at the next.

        The directions are those of the velocities with which bodies came to the step: pymunk lets a
        slip end for the whole kick, and that makes other contacts slip after it.
        """
        contacts, pose = self._batch.contacts(), self._batch.state()[:, :3]
        slips, adds = Slips.of(contacts, pose, self._continuation.running), acceleration * self._dt
        sense = self._continuation.sense(slips, contacts, previous_velocity, adds)
        named = (sense != 0) & self._named[slips.bodies].any(axis=1)
        most = self._coefficients[contacts.bodies[:, 0], contacts.bodies[:, 1]] * contacts.normal
        weakened = named & (contacts.friction < most * (1 - WEAKER))
        ends = weakened | self.ends(slips, sense, contacts, velocity + adds, adds)
        if ends.any():
            half_on = self._continuation.sense(slips, contacts, velocity + adds / 2, adds)
            weakened |= ends & (half_on != sense)
        steps = self.time_to_stop(slips, sense, velocity, adds)
        return SlipState(pose, slips, sense, ends, weakened, float(steps.min()))

    def ends(
        self, slips: Slips, sense: Array, contacts: Contacts, velocity: Array, adds: Array
    ) -> Booleans:
        """Return which contacts of named bodies no longer slip at these velocities: (k,)."""
        later = self._continuation.sense(slips, contacts, velocity, adds)
        return (sense != 0) & self._named[slips.bodies].any(axis=1) & (later != sense)

    def time_to_stop(
        self, slips: Slips, sense: Array, velocity: Array, acceleration: Array
    ) -> Array:
        """Return the time until each contact of named bodies stops slipping: (k,) [s].

        It is infinite if the slip does not slow down.
        """
        speed, change = sense * slips.speed(velocity), sense * slips.change(acceleration)
        slows = (change < 0) & self._named[slips.bodies].any(axis=1)
        wait = np.full(len(sense), np.inf)
        np.divide(speed, -change, out=wait, where=slows)
        return np.maximum(wait, 0.0)
