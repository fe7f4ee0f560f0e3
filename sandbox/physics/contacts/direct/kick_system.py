"""The system of equations of a kick, before it is solved."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.gap_functions import Features, features
from sandbox.physics.contacts.direct.row_layout import Layout
from sandbox.physics.engine.batch import NO_CONTACTS, Booleans, Contacts
from sandbox.physics.joints.exact.constraints import Coordinates, Rows, blur
from sandbox.physics.joints.exact.shake import ExactJoints

PROUD = 1e-9
"""m, how deep what closes within a drift comes: touching exactly is not touching."""

LIFTS = 1e-8
"""m, by which a point must leave in a drift to be one that has no friction: by less, w, it and the
other point of its side, l away, slip alike to w² / l."""


@dataclass  # not frozen: made in every step
class Kick:
    """The rows of a kick; r of them, N bodies with the plane.

    Attributes
    ----------
    joints, contacts
        What is joined, and what touches.
    layout, features
        The rows, and what touches where.
    place
        Where everything is.
    here
        The rows where everything is.
    response
        (r, 3 N), the velocities that a unit impulse of each gives: J M⁻¹.
    runs
        (f,), how fast surfaces slip by themselves, as belts do [m/s].
    before, after
        (m,), what the joints keep before and after the drift [m, rad].
    closes
        How many of the contacts, the last ones, do not touch yet but within the drift.
    """

    joints: ExactJoints
    contacts: Contacts
    layout: Layout
    features: Features
    place: Coordinates
    here: Rows
    response: Array
    runs: Array
    before: Array
    after: Array
    closes: int = 0

    @classmethod
    def at(
        cls,
        place: Coordinates,
        joints: ExactJoints,
        contacts: Contacts,
        layout: Layout,
        running: Array,
        lengths: tuple[Array, Array],
        closes: int = 0,
    ) -> "Kick":
        """Return that of a place.

        Parameters
        ----------
        running
            (n, 2), how fast the bodies' surfaces run [m/s].
        lengths
            What the joints keep before and after the drift, (m,) each [m, rad].
        closes
            How many of the contacts meet only within the drift: the last ones.
        """
        found = features(contacts, layout.touching, place, joints.origin)
        here = rows_at(place, joints, found)
        response, runs = here.jacobian * joints.inverse, _runs(contacts, layout, running)
        return cls(
            joints, contacts, layout, found, place, here, response, runs, *lengths, closes=closes
        )

    def moved(self, place: Coordinates) -> "Kick":
        """Return the same elsewhere, where bodies push along other directions."""
        kick, contacts = self._on(self.features.moved(place), place), self.contacts
        pairs = np.arange(len(contacts.bodies))  # the first points of all come first
        columns = 2 * contacts.bodies[:, 1:] + (0, 1)
        direction = kick.here.jacobian[self.layout.gaps][pairs[:, None], columns]
        kick.contacts = contacts._replace(direction=direction)
        return kick

    def strikes(self, moved: Array, laws: Array, pulls: Array) -> bool:
        """Return whether a gap that is yet to close does so faster than what acts makes it.

        Parameters
        ----------
        moved
            (3 N,), the velocities after the kick [m/s, rad/s].
        laws, pulls
            (3 N,), what force laws give, and what joints and contacts do [m/s², rad/s²].
        """
        jacobian = self.here.jacobian[self.layout.gaps][self.ahead]
        closing, *others = np.stack((moved, laws, laws + pulls)) @ jacobian.T
        return bool((closing < -np.maximum(*np.abs(others)) * self.joints.drift).any())

    def contacts_at(self, place: Coordinates) -> Contacts:
        """Return the contacts that are still closed elsewhere, less those that are yet to close.

        A corner, or what is round, takes its point along; a side stays what it is.
        """
        if len(self.contacts.bodies) == self.closes:
            return NO_CONTACTS
        there, touching = self.moved(place), self.layout.touching
        each = np.arange(len(touching.pair))
        guest = (self.features.side == touching.bodies[0]).astype(np.intp)
        body, sense = touching.bodies[guest, each], 1 - 2 * guest
        arm = self.features.points[guest, each]
        first, last = (at.plane[body] + arm * at.turned[body] for at in (self.place, place))
        old, new = (
            kick.contacts.direction.view(complex).take(touching.pair) for kick in (self, there)
        )
        points = np.ascontiguousarray(self.contacts.points).view(complex)[..., 0].copy()
        depths, number, origin = self.contacts.depths.copy(), touching.number, self.joints.origin
        depth = depths.take(number)
        tip = points.take(number) - origin + sense * old * depth / 2
        depth -= (there.here.total - self.here.total)[self.layout.gaps]
        tip = last + (tip - first) * (new / old)
        points.reshape(-1)[number] = tip - sense * new * depth / 2 + origin
        depths.reshape(-1)[number] = depth
        moved = there.contacts._replace(
            points=np.stack((points.real, points.imag), 2), depths=depths
        )
        return _shut(moved, len(moved.bodies) - self.closes)

    def between(self, place: Coordinates, before: Array, after: Array) -> "Kick":
        """Return the same elsewhere, before a drift between other lengths of the joints: (m,)."""
        return self.moved(place).lasting(before, after)

    def lasting(self, before: Array, after: Array) -> "Kick":
        """Return the same before a drift between other lengths of the joints: (m,) each."""
        return replace(self, before=before, after=after)

    def leaning(self, moved: Array, forces: Array) -> "Kick | None":
        """Return the same with friction where sides press that lift their first point.

        One of the two points of a side stands for the friction of both: they slip alike as long as
        it lies flat. None if all sides do.

        Parameters
        ----------
        moved, forces
            The velocities after the kick, (3 N,) [m/s, rad/s], and its forces, (r,) [N].
        """
        first, gaps = self.layout.gaps.start, self.layout.gaps
        one, other = self.layout.problem.friction.contact
        bears = (forces[one] <= 0) & (other >= 0) & (forces[other] > 0)
        if not np.count_nonzero(bears):
            return None
        leaves = self.here.jacobian[gaps] @ moved * self.joints.drift > LIFTS
        bears &= leaves[one - first]
        if not np.count_nonzero(bears):
            return None
        touching = self.layout.touching.rubbing_at(np.where(bears, other, one) - first)
        found = features(self.contacts, touching, self.place, self.joints.origin)
        return self._on(found, self.place)

    def _on(self, found: Features, place: Coordinates) -> "Kick":
        """Return the same with other points, or elsewhere."""
        here = rows_at(place, self.joints, found)
        return Kick(
            self.joints,
            self.contacts,
            self.layout,
            found,
            place,
            here,
            here.jacobian * self.joints.inverse,
            self.runs,
            self.before,
            self.after,
            self.closes,
        )

    def rows(self, way: Array) -> Rows:
        """Return the rows after a way, (3 N,): joints as what is left of what they keep."""
        return rows_at(Coordinates(self.place.values + way), self.joints, self.features)

    def flat_rows(self, way: Array) -> Rows:
        """Return the same, with contacts as if they changed linearly with the way."""
        here, there, touch = self.here, self.rows(way), self.layout.touch
        total, jacobian = there.total.copy(), there.jacobian.copy()
        total[touch] = here.total[touch] + here.jacobian[touch] @ way
        jacobian[touch] = here.jacobian[touch]
        return Rows(total, jacobian)

    def targets(self) -> Array:
        """Return what the rows shall be after the drift: (r,)."""
        wanted = self.here.total.copy()
        wanted[self.layout.joints] = -self.after
        wanted[self.layout.slips] -= self.joints.drift * self.runs
        if self.closes:
            closed = self.contacts.depths.take(self.layout.touching.number) - PROUD
            wanted[self.layout.gaps] += np.where(self.ahead, closed, 0.0)
        return wanted

    @cached_property
    def ahead(self) -> Booleans:
        """Which gaps are yet to close: (k,)."""
        return np.asarray(self.layout.touching.pair >= len(self.contacts.bodies) - self.closes)

    @cached_property
    def blur(self) -> float:
        """How well velocities are known that are chosen by places [m/s]."""
        return blur(self.place.values, self.joints.drift)

    def joint_rates(self) -> Array:
        """Return how fast what joints keep grows at the step: (m,) [m/s, rad/s]."""
        return np.asarray((self.after - self.before) / self.joints.drift)

    def wrenches(self, impulse: Array, body: int) -> Array:
        """Return what such impulses, (r,), do to a body, pair by pair: (2, k, 3) [N s, N m s].

        First what pushes, then friction; each along its row, as far as that is of the pair.
        """
        layout, touching = self.layout, self.layout.touching
        columns = [2 * body, 2 * body + 1, len(self.place.values) // 3 * 2 + body]
        given = impulse[:, None] * self.here.jacobian[:, columns]
        found = np.zeros((2, len(self.contacts.bodies), 3))
        np.add.at(found[0], touching.pair, given[layout.gaps])
        found[1, touching.rubs] = given[layout.slips]
        return found

    def pushing(self, impulse: Array) -> Contacts:
        """Return the contacts with such impulses, (r,)."""
        layout, touching = self.layout, self.layout.touching
        number = len(self.contacts.bodies)
        normal = np.bincount(touching.pair, impulse[layout.gaps], number).astype(float, copy=False)
        friction = np.zeros(number)
        friction[touching.rubs] = impulse[layout.slips]
        push = self.contacts.direction.view(complex) * (normal + 1j * friction)[:, None]
        return self.contacts._replace(
            normal=normal, friction=np.abs(friction), impulse=push.view(float)
        )


def _shut(contacts: Contacts, count: int) -> Contacts:
    """Return so many of the first contacts, with those of their points that are closed."""
    shut = (contacts.depths > -PROUD) & (np.arange(2) < contacts.touches[:, None])
    second = ~shut[:, 0]
    points, depths = contacts.points.copy(), contacts.depths.copy()
    points[second, 0], depths[second, 0] = points[second, 1], depths[second, 1]
    left = contacts._replace(touches=shut.sum(axis=1), points=points, depths=depths)
    stay = shut[:count].any(axis=1)
    return Contacts._make(field[:count][stay] for field in left)


def rows_at(place: Coordinates, joints: ExactJoints, found: Features) -> Rows:
    """Return all rows somewhere: joints as what is left of what they keep."""
    first = len(joints.pulls_only)
    count = first + len(found.touching.rows)
    total, jacobian = np.empty(count), np.zeros((count, len(place.values)))
    found.look(place, total[first:], jacobian[first:])
    if first:
        held = joints.look(place)
        np.negative(held.total, out=total[:first])
        np.negative(held.jacobian, out=jacobian[:first])
    return Rows(total, jacobian)


def _runs(contacts: Contacts, layout: Layout, running: Array) -> Array:
    (a, b), rubs = layout.touching.sliding, layout.touching.rubs
    if not np.count_nonzero(running):
        return np.zeros(len(rubs))
    runs = running[b] - running[a]
    direction = contacts.direction[layout.touching.pair[rubs]]
    return np.asarray(runs[:, 1] * direction[:, 0] - runs[:, 0] * direction[:, 1])
