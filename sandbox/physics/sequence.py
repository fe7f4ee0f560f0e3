"""Impacts one after the other, as those of hard bodies that touch each other are.

pymunk solves all contacts of a step at once, so a shot into a row of touching balls moves several
of them. Here, between drift and kick, the pair that approaches fastest collides first: an impulse
along its normal turns its approach into e times as fast a parting (Newton's law of restitution),
which may make neighbours approach, and so on until no pair does. What pymunk's solver then finds
are bodies that part or rest.

The velocities that collide are those *at* the step, half a kick after pymunk's: the speed of an
impact is of second order, whatever pulls.

Bodies with e < 1 that stay together would collide for ever, ever more gently. From some point on
they no longer bounce, and what is left is solved at once: no pair may approach, and only pushes are
allowed.
"""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.batch import Batch, Booleans, Contacts, Integers
from sandbox.physics.errors import EndlessImpacts
from sandbox.physics.exact.solver import ExactJoints
from sandbox.physics.impacts import reached

ROUNDING = 1e-12
"""An approach slower than this share of the speeds that it is the difference of is none."""

MANY = 100
"""How many impacts each contact of a pile-up may have before what is left stops bouncing. Twice as
many as 50 equal balls in a row with e = 0.9 need; those with less stay together by then."""

MOST = 300_000
"""The same for all contacts together where one is elastic: there, nothing may be left."""

TINY = 1e-300

PARALLEL = 1e-9
"""The determinant, of two points' answers to impulses, below which they are one point."""


class Impacts(NamedTuple):
    """What the impacts of a step did; n bodies.

    Attributes
    ----------
    jump
        (n, 3), the changes of the velocities [m/s, rad/s].
    velocity
        (n, 3), the velocities at the step, right after them [m/s, rad/s].
    impulse
        (n,), the sizes of the impulses on each body, added up [N s].
    """

    jump: Array
    velocity: Array
    impulse: Array


class Sequence:
    """Finds the impacts of a step, and lets one come after the other; n bodies.

    Parameters
    ----------
    batch
        Reads and writes the bodies.
    restitution
        (n, n), the pairs' coefficients.
    agility
        (n, 3), what a force or torque is multiplied by to give an acceleration [1/kg, 1/(kg m²)].
    joints
        Those that hold together what collides, if there are any. An impulse passes through what
        can push as well as pull; ropes and strings are jerked by what comes of it.
    dt
        The time step [s].
    """

    def __init__(
        self,
        batch: Batch,
        restitution: Array,
        agility: Array,
        joints: ExactJoints | None,
        dt: float,
    ) -> None:
        self._batch, self._joints, self._dt = batch, joints, dt
        self._restitution, self._agility = restitution, agility
        self._moving: Booleans = agility[:, 0] > 0
        self._turning: Booleans = agility[:, 2] > 0
        self._begun = self._pull = np.zeros_like(
            agility
        )  # the last kick: velocities, accelerations
        self._lasted = dt
        self.last = Impacts(self._begun, self._begun, self._begun[:, 0])

    def collide(self, pull: Array, *, start: bool) -> None:
        """Let what touches and approaches collide, and change the velocities.

        Parameters
        ----------
        pull
            (n, 3), the accelerations by gravity and force laws at the step [m/s², rad/s²].
        start
            Whether this is the first kick, of half a step, which begins with the velocities at it.

        Raises
        ------
        EndlessImpacts
            If elastic bodies collide more often than can be followed.
        """
        state = self._batch.state()
        begins = state[:, 3:]
        velocity = begins
        if not start:
            held = (begins - self._begun) / self._lasted - self._pull  # by contacts and joints
            velocity = begins + (pull + held) * (self._dt / 2)
        jump, impulse = np.zeros_like(begins), np.zeros(len(begins))
        contacts = self._batch.contacts()
        if len(contacts.bodies):
            self._exchange(contacts, state[:, :2], velocity, pull, jump, impulse)
            if impulse.any():
                self._batch.set_velocity(begins + jump)
        self.last = Impacts(jump, velocity + jump, impulse)
        self._begun, self._pull = begins + jump, pull
        self._lasted = self._dt / 2 if start else self._dt

    def shift(self, jump: Array) -> None:
        """Take in how velocities jumped since the last kick, by impacts located in time: (n, 3)."""
        self._begun = self._begun + jump

    def _exchange(
        self,
        contacts: Contacts,
        place: Array,
        velocity: Array,
        pull: Array,
        jump: Array,
        impulse: Array,
    ) -> None:
        """Add what the impacts do to jump and impulse."""
        points = _points(contacts, place, self._turning)
        parts = np.einsum("kbc,kbc->kb", points.gradient, velocity[points.bodies])
        parting = parts.sum(axis=1)
        adds = np.einsum("kbc,kbc->k", points.gradient, pull[points.bodies])
        allowed = np.maximum(np.abs(adds) * self._dt, ROUNDING * np.abs(parts).max(axis=1))
        struck = parting < -allowed
        if not struck.any():
            return
        if not self._joints:  # what is not reached need not be looked at
            touched = reached(points.bodies, struck, self._moving)
            near = touched[points.bodies[:, 0]] | touched[points.bodies[:, 1]]
            points, parting, allowed = points.only(near), parting[near], allowed[near]
        gradient = points.over(len(place))
        answer = answers(gradient, self._agility, self._joints)
        a, b = points.bodies.T
        pile = _Pile(
            answer.reshape(len(parting), -1) @ gradient.reshape(len(parting), -1).T,
            parting,
            allowed,
            self._restitution[a, b],
            points.partner,
        )
        pushes = pile.settle(points.bodies)
        jump += np.tensordot(pushes, answer, 1)
        np.add.at(impulse, a, pushes)
        np.add.at(impulse, b, pushes)


def answers(gradient: Array, agility: Array, joints: ExactJoints | None) -> Array:
    """Return how bodies, joints included, answer a unit impulse along each gradient: (k, n, 3)."""
    answer = gradient * agility
    if not joints:
        return answer
    holds = joints.stiff().reshape(-1, agility.size)
    held = holds * agility.reshape(-1)
    flat = answer.reshape(len(answer), -1)
    return (flat - np.linalg.solve(held @ holds.T, holds @ flat.T).T @ held).reshape(answer.shape)


class _Points(NamedTuple):
    """The points at which pairs touch; k of them.

    Attributes
    ----------
    bodies
        (k, 2).
    gradient
        (k, 2, 3), how fast the two bodies' velocities take them apart.
    partner
        (k,), the other point of the same two sides; −1 if there is none.
    """

    bodies: Integers
    gradient: Array
    partner: Integers

    def only(self, near: Booleans) -> "_Points":
        """Return some of the points; partners go together."""
        renumbered = np.append(np.cumsum(near) - 1, -1)
        return _Points(self.bodies[near], self.gradient[near], renumbered[self.partner[near]])

    def over(self, count: int) -> Array:
        """Return the gradients over all bodies: (k, n, 3)."""
        whole = np.zeros((len(self.bodies), count, 3))
        rows = np.arange(len(self.bodies))
        for side in range(2):
            whole[rows, self.bodies[:, side]] = self.gradient[:, side]
        return whole


def _points(contacts: Contacts, place: Array, turning: Booleans) -> _Points:
    """Return where pairs touch; without rotation one point of a side stands for all."""
    count = len(contacts.bodies)
    two = np.flatnonzero((contacts.touches == 2) & turning[contacts.bodies].any(axis=1))
    pair = np.concatenate((np.arange(count), two))
    which = np.repeat((0, 1), (count, len(two)))
    partner = np.full(len(pair), -1)
    partner[two], partner[count:] = count + np.arange(len(two)), two
    bodies, direction = contacts.bodies[pair], contacts.direction[pair]
    arm = contacts.points[pair, which][:, None] - place[bodies]
    gradient = np.empty((len(pair), 2, 3))
    gradient[:, :, :2] = direction[:, None]
    gradient[:, :, 2] = arm[..., 0] * direction[:, None, 1] - arm[..., 1] * direction[:, None, 0]
    gradient[:, 0] *= -1
    return _Points(bodies, gradient, partner)


class _Pile:
    """Contacts that may collide with each other; k of them.

    Parameters
    ----------
    answers
        (k, k), how fast each parts by a unit impulse of each [1/kg].
    parting
        (k,), how fast each parts [m/s].
    allowed
        (k,), the approach that is none [m/s].
    restitution
        (k,).
    partner
        (k,), see `_Points`.
    """

    def __init__(
        self,
        answers: Array,
        parting: Array,
        allowed: Array,
        restitution: Array,
        partner: Integers,
    ) -> None:
        self._answers, self._parting, self._allowed = answers, parting.copy(), allowed
        self._restitution, self._partner = restitution, partner
        self._impulse = np.zeros(len(parting))

    def settle(self, bodies: Integers) -> Array:
        """Return the impulses after which nothing approaches: (k,) [N s]."""
        bounces = self._restitution > 0
        most = MANY * len(bounces) if bounces.any() else 0
        if (self._restitution == 1).any():
            most = MOST
        for _ in range(most):
            fastest = int((self._parting + self._allowed).argmin())
            if self._parting[fastest] >= -self._allowed[fastest]:
                return self._impulse
            self._bounce(fastest)
        fastest = int((self._parting + self._allowed).argmin())
        if most and self._restitution[fastest] == 1:
            raise EndlessImpacts(int(bodies[fastest].max()))
        self._impulse += pushes(self._answers, self._parting)
        return self._impulse

    def _bounce(self, first: int) -> None:
        """Turn round the approach of a point, and of its partner if that approaches too."""
        e, second = self._restitution[first], int(self._partner[first])
        if second >= 0 and self._parting[second] < -self._allowed[second]:
            both = np.array((first, second))
            block = self._answers[np.ix_(both, both)]
            if np.linalg.det(block) > PARALLEL * block[0, 0] * block[1, 1]:
                size = -(1 + e) * np.linalg.solve(block, self._parting[both])
                if size.min() >= 0:
                    self._impulse[both] += size
                    self._parting += size @ self._answers[both]
                    return
        push = -(1 + e) * self._parting[first] / self._answers[first, first]
        self._impulse[first] += push
        self._parting += push * self._answers[first]


def pushes(answers: Array, parting: Array) -> Array:
    """Return the smallest impulses after which nothing approaches, all at once: (k,) [N s].

    Of all impulses that push, those that leave the least kinetic energy: impulse · (parting +
    answers · impulse / 2) is least. C. L. Lawson, R. J. Hanson: Solving Least Squares Problems,
    chapter 23.
    """
    impulse, active = np.zeros(len(parting)), np.zeros(len(parting), dtype=bool)
    close = ROUNDING * np.abs(parting).max()
    for _ in range(3 * len(parting)):
        approach = np.where(active, -np.inf, -(parting + answers @ impulse))
        worst = int(approach.argmax())
        if approach[worst] <= close:
            break
        active[worst] = True
        while True:
            now = np.flatnonzero(active)
            wanted = np.linalg.lstsq(answers[np.ix_(now, now)], -parting[now], rcond=None)[0]
            if wanted.min() > 0:
                impulse[now] = wanted
                break
            pulls = wanted <= 0
            left = impulse[now][pulls]
            share = left / np.maximum(left - wanted[pulls], TINY)
            impulse[now] += share.min() * (wanted - impulse[now])
            active[now[np.flatnonzero(pulls)[share == share.min()]]] = False
            impulse[~active] = 0.0
            if not active.any():
                break
    return impulse
