"""Sequential impacts: hard bodies that touch each other collide one pair after the other.

pymunk solves all contacts of a step at once, so a shot into a row of touching balls moves several
of them. Here, between drift and kick, the pair that approaches fastest collides first: an impulse
along its normal reverses the approach velocity, scaled by e (Newton's law of restitution). That may
make neighbours approach, and so on until no pair does. For pymunk's solver there then remain only
bodies that separate or rest.

The velocities before impacts are those *at* the step, half a kick after pymunk's, so the speed of
an impact is of second order under any forces.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_kinematics import over_bodies, pair_jacobian
from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
from sandbox.physics.contacts.impacts.impact_step_velocity import reached
from sandbox.physics.contacts.impacts.pile_impacts import ROUNDING, Pile
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Batch, Booleans, Contacts, Integers

FAINTEST = 1e-290
"""m/s: slower approaches count as zero. The smallest numbers have few digits, so rounding is no
fixed share of them."""


class Sequence:
    """Finds and solves the impacts of a step, one after the other; n bodies.

    `batch` reads and writes the bodies, and `restitution`, (n, n), are the coefficients of
    restitution of the pairs. `inverse_mass`, (n, 3), has the inverses of masses, masses and moments
    of inertia [1/kg, 1/(kg m²)]; `dt` is the time step [s].
    """

    def __init__(self, batch: Batch, restitution: Array, inverse_mass: Array, dt: float) -> None:
        self._batch, self._dt = batch, dt
        self._restitution, self._inverse_mass = restitution, inverse_mass
        self._moving: Booleans = inverse_mass[:, 0] > 0
        self._turning: Booleans = inverse_mass[:, 2] > 0
        self._velocity_before = self._law_acceleration = np.zeros_like(inverse_mass)
        self._last_duration = dt
        self._before: partial[Array] | None = None  # constraint accelerations in the kick before
        self.last = ImpactOutcome.none(len(inverse_mass))
        self._asked, self._pushes = b"", np.zeros(0)  # the last pile-up, and its impulses
        self._indices = _PointIndices.of(NO_CONTACTS, self._turning)

    def collide(self, law_acceleration: Array, *, start: bool) -> None:
        """Let touching bodies that approach collide, and change their velocities.

        `law_acceleration`, (n, 3), are the accelerations by gravity and force laws at the
        step [m/s², rad/s²]. `start` tells whether this is the first kick, of half a step, which
        begins with the velocities at its time. Raises `EndlessImpacts` if elastic bodies collide
        more often than can be followed.
        """
        state = self._batch.state()
        last_kick = self._velocity_before, self._last_duration, self._law_acceleration
        velocity = begins = state[:, 3:]
        jump, impulse = np.zeros_like(begins), np.zeros(len(begins))
        contacts = self._batch.contacts()
        if len(contacts.bodies):
            constraint_acceleration = before = np.zeros_like(law_acceleration)
            if not start:
                constraint_acceleration = _constraint_acceleration(begins, *last_kick)
                before = self._before() if self._before else constraint_acceleration
                velocity = begins + (law_acceleration + constraint_acceleration) * (self._dt / 2)
            nothing = np.zeros_like(constraint_acceleration)
            other = np.stack((nothing, constraint_acceleration, before))  # by joints and contacts
            gives = (law_acceleration + other) * self._dt
            self._exchange(contacts, state[:, :2], velocity, gives, jump, impulse)
            if impulse.any():
                self._batch.set_velocity(begins + jump)
        self.last = ImpactOutcome(np.asarray(jump.any(axis=1)), jump, velocity + jump, impulse)
        self._before = None if start else partial(_constraint_acceleration, begins, *last_kick)
        self._velocity_before, self._law_acceleration = begins + jump, law_acceleration
        self._last_duration = self._dt / 2 if start else self._dt

    def shift(self, jump: Array, acceleration_change: Array) -> None:
        """Add the impacts located in time since the last kick; see `located_impacts.Cut`."""
        unfelt = acceleration_change * self._last_duration
        self._velocity_before = self._velocity_before + jump - unfelt

    def _exchange(
        self,
        contacts: Contacts,
        positions: Array,
        velocity: Array,
        gives: Array,
        jump: Array,
        impulse: Array,
    ) -> None:
        """Add the outcome of the impacts to `jump` and `impulse`; for `gives` see `_allowed`."""
        if not self._indices.are_of(contacts):
            self._indices = _PointIndices.of(contacts, self._turning)
        points = self._indices.points(contacts, positions)
        parts = np.einsum("kbc,kbc->kb", points.jacobian, velocity[points.bodies])
        parting = parts.sum(axis=1)
        rounding = ROUNDING * np.abs(parts).max(axis=1) + FAINTEST
        if not np.count_nonzero(parting < -rounding):
            return
        allowed = np.maximum(_allowed(points, gives), rounding)
        struck = parting < -allowed
        if not struck.any():
            return
        touched = reached(points.bodies, struck, self._moving)
        near = touched[points.bodies[:, 0]] | touched[points.bodies[:, 1]]
        points, parting, allowed = points.only(near), parting[near], allowed[near]
        jacobian = points.over(len(positions))
        response = jacobian * self._inverse_mass
        delassus = response.reshape(len(parting), -1) @ jacobian.reshape(len(parting), -1).T
        a, b = points.bodies.T
        asked = b"".join(x.tobytes() for x in (points.bodies, delassus, parting, allowed))
        if asked != self._asked:  # kicks of held bodies are repeated
            pile = Pile(delassus, parting, allowed, self._restitution[a, b], points.partner)
            self._asked, self._pushes = asked, pile.settle(points.bodies)
        pushes = self._pushes
        jump += np.tensordot(pushes, response, 1)
        np.add.at(impulse, a, pushes)
        np.add.at(impulse, b, pushes)


def _constraint_acceleration(
    velocity_after: Array, velocity_before: Array, duration: float, smooth: Array
) -> Array:
    """Return the accelerations in a kick except by gravity and laws: (n, 3) [m/s², rad/s²]."""
    acceleration: Array = (velocity_after - velocity_before) / duration - smooth
    return acceleration


class _Points(NamedTuple):
    """The k contact points of pairs.

    `bodies`, (k, 2), are those of each point; `jacobian`, (k, 2, 3), is that of the separation
    rate, for the velocities of the two bodies. `partner`, (k,), is the other contact point of the
    same two sides; −1 if there is none.
    """

    bodies: Integers
    jacobian: Array
    partner: Integers

    def only(self, near: Booleans) -> "_Points":
        """Return some of the points, always with their partners."""
        renumbered = np.append(np.cumsum(near) - 1, -1)
        return _Points(self.bodies[near], self.jacobian[near], renumbered[self.partner[near]])

    def over(self, count: int) -> Array:
        """Return the Jacobian over all bodies: (k, n, 3)."""
        return over_bodies(self.jacobian, self.bodies, count)


class _PointIndices(NamedTuple):
    """The indices of contact points; without rotation, one point of a side represents both.

    `pairs` and `touches` are the bodies of the contacts, and their numbers of contact points; see
    `Contacts`. `pair` and `which`, (k,), are the contact of each point, and the index of the point
    in it; `bodies`, (k, 2), and `partner`, (k,), are as in `_Points`.
    """

    pairs: Integers
    touches: Integers
    pair: Integers
    which: Integers
    bodies: Integers
    partner: Integers

    @classmethod
    def of(cls, contacts: Contacts, turning: Booleans) -> "_PointIndices":
        """Return the indices for contacts, given the bodies that can rotate, (n,)."""
        pairs, touches, count = contacts.bodies, contacts.touches, len(contacts.bodies)
        two = np.flatnonzero((touches == 2) & turning[pairs].any(axis=1))
        pair = np.concatenate((np.arange(count), two))
        partner = np.full(len(pair), -1)
        partner[two], partner[count:] = count + np.arange(len(two)), two
        which = np.repeat((0, 1), (count, len(two)))
        return cls(pairs, touches, pair, which, pairs[pair], partner)

    def are_of(self, contacts: Contacts) -> bool:
        """Return whether contacts have the same pairs and numbers of points: the same arrays."""
        return contacts.bodies is self.pairs and contacts.touches is self.touches

    def points(self, contacts: Contacts, positions: Array) -> _Points:
        """Return the contact points, given the positions of the bodies, (n, 2) [m]."""
        at = contacts.points[self.pair, self.which]
        arm = at[:, None] - positions[self.bodies]
        jacobian = pair_jacobian(arm, contacts.direction[self.pair])
        return _Points(self.bodies, jacobian, self.partner)


def _allowed(points: _Points, gives: Array) -> Array:
    """Return the approach velocity of bodies that rest, which is left to pymunk: (k,) [m/s].

    It is the change by gravity and laws in a step, or by these and the constraint forces of the
    last kick, if that is larger. The latter is bounded by the forces of the kick before: anything
    beyond is a jerk, and does not count.

    `gives`, (3, n, 3), are these three accelerations as changes of velocity in a step [m/s, rad/s].
    """
    both = points.jacobian, gives[2, points.bodies]
    sizes = [np.sqrt(np.add.reduce(a * a, axis=2)) for a in both]
    adds = np.einsum("kbc,skbc->sk", points.jacobian, gives[:2, points.bodies])
    alone, with_constraints = np.abs(adds)
    return np.asarray(
        np.maximum(alone, np.minimum(with_constraints, np.sum(sizes[0] * sizes[1], axis=1)))
    )
