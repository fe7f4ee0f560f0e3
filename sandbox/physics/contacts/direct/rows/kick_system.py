"""The system of equations of a kick, before it is solved."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.gap_functions import Features, features
from sandbox.physics.contacts.direct.rows.row_layout import Layout
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts
from sandbox.physics.joints.exact.constraint_interface import (
    QUADRATIC,
    Coordinates,
    Rows,
    angles,
    blur,
    translations,
)
from sandbox.physics.joints.exact.joint_system import KeptLengths
from sandbox.physics.joints.exact.shake import TAUT, ExactJoints

PROUD = 1e-9
"""m, the overlap with which a gap closes within a drift: exactly 0 would not count as contact."""

LIFTS = 1e-8
"""m: a point that separates by more than this in a drift loses its friction. If it separates by
less, w, its slip differs by w² / l from that of the other point of its side, at a distance l."""


OPENS = 0.1
"""m/s: bodies that overlap, where a gap between them should close, part no faster than this. They
would be shot out within a very brief part of a drift."""


@dataclass  # not frozen: made in every step
class Kick:
    """The rows of a kick; r of them, N bodies with the plane.

    Attributes
    ----------
    joints, contacts
        The exact joints and the contacts.
    layout, features
        The layout of the rows, and the contact points.
    pose
        The positions of the bodies.
    rows_at_start
        The rows at these positions.
    response
        (r, 3 N), the velocity changes by a unit impulse of each row: J M⁻¹.
    belt_slip
        (f,), the slip velocities of running surfaces, such as belts [m/s].
    kept_lengths
        The lengths that joints keep before and after the drift, and the time of the kick.
    closing_count
        How many of the contacts, the last ones, are still open, and close within the drift.
    """

    joints: ExactJoints
    contacts: Contacts
    layout: Layout
    features: Features
    pose: Coordinates
    rows_at_start: Rows
    response: Array
    belt_slip: Array
    kept_lengths: KeptLengths
    closing_count: int = 0

    @classmethod
    def at(
        cls,
        pose: Coordinates,
        joints: ExactJoints,
        contacts: Contacts,
        layout: Layout,
        running: Array,
        kept_lengths: KeptLengths,
        closes: int = 0,
    ) -> "Kick":
        """Return the system at given positions.

        `running`, (n, 2), are the velocities of running surfaces relative to their bodies [m/s];
        `kept_lengths` are the lengths that joints keep before and after the drift.
        The last `closing_count` contacts close only within the drift.
        """
        found = features(contacts, layout.touching, pose, joints.origin)
        rows = rows_at(pose, joints, found)
        response, runs = rows.jacobian * joints.inverse, _runs(contacts, layout, running)
        return cls(
            joints,
            contacts,
            layout,
            found,
            pose,
            rows,
            response,
            runs,
            kept_lengths,
            closing_count=closes,
        )

    def at_pose(self, pose: Coordinates) -> "Kick":
        """Return the system of the same contacts at other positions, with their normals there."""
        kick, contacts = self._on(self.features.moved(pose), pose), self.contacts
        pairs = np.arange(len(contacts.bodies))  # the first points of all come first
        columns = 2 * contacts.bodies[:, 1:] + (0, 1)
        direction = kick.rows_at_start.jacobian[self.layout.gaps][pairs[:, None], columns]
        kick.contacts = contacts._replace(direction=direction)
        return kick

    def strikes(self, velocity: Array, laws: Array, pulls: Array) -> bool:
        """Return whether a gap that is still open closes faster than forces alone could cause.

        `velocity`, (3 N,), are the velocities after the kick [m/s, rad/s]; `laws` and `pulls`, (3
        N,), are the accelerations by force laws, and by joints and contacts [m/s², rad/s²].
        """
        jacobian = self.rows_at_start.jacobian[self.layout.gaps][self.ahead]
        closing, *others = np.stack((velocity, laws, laws + pulls)) @ jacobian.T
        return bool((closing < -np.maximum(*np.abs(others)) * self.joints.drift).any())

    def contacts_at(self, pose: Coordinates, without: Sequence[int] = ()) -> Contacts:
        """Return the contacts that are still closed at other positions, `without` some."""
        return _shut(self.carried(pose), without) if len(self.contacts.bodies) else NO_CONTACTS

    def open_at(self, pose: Coordinates) -> Contacts:
        """Return the contacts that are still to close at other positions."""
        if not self.closing_count:
            return NO_CONTACTS
        moved, count = self.carried(pose), len(self.contacts.bodies) - self.closing_count
        opened = np.asarray(~_shut_points(moved).any(axis=1))
        opened[:count] = False
        return Contacts._make(field[opened] for field in moved)

    def carried(self, pose: Coordinates) -> Contacts:
        """Return the contacts at other positions.

        Contact points move with their corner or disc, and along their side.
        """
        moved, touching = self.at_pose(pose), self.layout.touching
        each = np.arange(len(touching.pair))
        guest = (self.features.side[each] == touching.bodies[0]).astype(np.intp)
        body, sense = touching.bodies[guest, each], 1 - 2 * guest
        arm = self.features.points[guest, each]
        first, last = (at.position[body] + arm * at.rotation[body] for at in (self.pose, pose))
        old, new = (
            kick.contacts.direction.view(complex).take(touching.pair) for kick in (self, moved)
        )
        points = np.ascontiguousarray(self.contacts.points).view(complex)[..., 0].copy()
        depths, number, origin = self.contacts.depths.copy(), touching.number, self.joints.origin
        depth = depths.take(number)
        tip = points.take(number) - origin + sense * old * depth / 2
        depth -= (moved.rows_at_start.total - self.rows_at_start.total)[self.layout.gaps]
        tip = last + (tip - first) * (new / old)
        points.reshape(-1)[number] = tip - sense * new * depth / 2 + origin
        depths.reshape(-1)[number] = depth
        return moved.contacts._replace(
            points=np.stack((points.real, points.imag), 2), depths=depths
        )

    def between(self, pose: Coordinates, kept_lengths: KeptLengths) -> "Kick":
        """Return the system at other positions, for a drift between other lengths of the joints."""
        return self.at_pose(pose).before_drift(kept_lengths)

    def before_drift(self, kept_lengths: KeptLengths) -> "Kick":
        """Return the same before a drift between other lengths of the joints."""
        return replace(self, kept_lengths=kept_lengths)

    def with_tilt_friction(self, velocity: Array, forces: Array) -> "Kick | None":
        """Return the system with the friction of tilting sides at the point that bears the load.

        One of the two points of a side carries the friction of both: they slip alike as long as the
        side lies flat. None if all lie flat. `velocity`, (3 N,), are the velocities after the
        kick [m/s, rad/s], and `forces`, (r,), are its forces [N].
        """
        first, gaps = self.layout.gaps.start, self.layout.gaps
        if gaps.stop - first == len(self.contacts.bodies):  # each touches at one point
            return None
        one, other = self.layout.problem.friction.contact
        bears = (forces[one] <= 0) & (other >= 0) & (forces[other] > 0)
        if not np.count_nonzero(bears):
            return None
        leaves = self.rows_at_start.jacobian[gaps] @ velocity * self.joints.drift > LIFTS
        bears &= leaves[one - first]
        if not np.count_nonzero(bears):
            return None
        touching = self.layout.touching.with_friction_at(np.where(bears, other, one) - first)
        found = features(self.contacts, touching, self.pose, self.joints.origin)
        return self._on(found, self.pose)

    def _on(self, found: Features, pose: Coordinates) -> "Kick":
        """Return the system with other contact points, or at other positions."""
        rows = rows_at(pose, self.joints, found)
        response = rows.jacobian * self.joints.inverse
        return replace(self, features=found, pose=pose, rows_at_start=rows, response=response)

    def rows(self, displacement: Array) -> Rows:
        """Return the rows after a displacement, (3 N,); see `rows_at`."""
        return rows_at(Coordinates(self.pose.values + displacement), self.joints, self.features)

    def flat_rows(self, displacement: Array) -> Rows:
        """Return the same, with contacts linearized in the displacement."""
        rows_at_start, rows_at_end, touch = (
            self.rows_at_start,
            self.rows(displacement),
            self.layout.touch,
        )
        total, jacobian = rows_at_end.total.copy(), rows_at_end.jacobian.copy()
        total[touch] = rows_at_start.total[touch] + rows_at_start.jacobian[touch] @ displacement
        jacobian[touch] = rows_at_start.jacobian[touch]
        return Rows(total, jacobian)

    def targets(self) -> Array:
        """Return the target values of the rows after the drift: (r,)."""
        wanted = self.rows_at_start.total.copy()
        wanted[self.layout.joints] = -self.kept_lengths.after
        wanted[self.layout.slips] -= self.joints.drift * self.belt_slip
        if self.closing_count:
            closed = self.contacts.depths.take(self.layout.touching.number) - PROUD
            opens = OPENS * self.joints.drift
            wanted[self.layout.gaps] += np.where(self.ahead, np.minimum(closed, opens), 0.0)
        return wanted

    @cached_property
    def ahead(self) -> Booleans:
        """Which gaps are still open, and close within the drift: (k,)."""
        return np.asarray(
            self.layout.touching.pair >= len(self.contacts.bodies) - self.closing_count
        )

    @property
    def slack(self) -> Booleans:
        """Which one-sided joints are slack, or not reached: (m,)."""
        gap = self.rows_at_start.total[self.layout.joints] + self.kept_lengths.before
        return np.asarray(self.joints.pulls_only & (gap > TAUT + QUADRATIC))

    @cached_property
    def acts(self) -> Booleans:
        """Which bodies each row acts on: (r, n)."""
        acts = (translations(self.response) != 0) | (angles(self.response) != 0)
        return np.asarray(acts[:, :-1])

    @cached_property
    def velocity_rounding(self) -> float:
        """The rounding error of velocities that follow from positions [m/s]."""
        return blur(self.pose.values, self.joints.drift)

    def joint_rates(self) -> Array:
        """Return the mean rates of the lengths that joints keep in the drift: (m,) [m/s, rad/s]."""
        return np.asarray((self.kept_lengths.after - self.kept_lengths.before) / self.joints.drift)

    def rates_now(self) -> Array:
        """Return the rates of these lengths at the time of the kick: (m,) [m/s, rad/s].

        An impact is at that instant: with the mean rates of the drift after it, what a motor of
        changing rate drives would bounce with an error of first order.
        """
        return self.joints.equations.rates(self.kept_lengths.t)

    def wrenches(self, impulse: Array, body: int) -> Array:
        """Return the impulses on a body by each contact: (2, k, 3) [N s, N m s].

        First the normal ones, then friction; from the impulses of the rows, (r,).
        """
        layout, touching = self.layout, self.layout.touching
        columns = [2 * body, 2 * body + 1, len(self.pose.values) // 3 * 2 + body]
        impulses = impulse[:, None] * self.rows_at_start.jacobian[:, columns]
        found = np.zeros((2, len(self.contacts.bodies), 3))
        np.add.at(found[0], touching.pair, impulses[layout.gaps])
        found[1, touching.friction_points] = impulses[layout.slips]
        return found

    def contacts_with(self, impulse: Array) -> Contacts:
        """Return the contacts with the impulses of the rows, (r,)."""
        layout, touching = self.layout, self.layout.touching
        number = len(self.contacts.bodies)
        normal = np.bincount(touching.pair, impulse[layout.gaps], number).astype(float, copy=False)
        friction = np.zeros(number)
        friction[touching.friction_points] = impulse[layout.slips]
        push = self.contacts.direction.view(complex) * (normal + 1j * friction)[:, None]
        return self.contacts._replace(
            normal=normal, friction=np.abs(friction), impulse=push.view(float)
        )


def _shut(contacts: Contacts, without: Sequence[int]) -> Contacts:
    """Return contacts, `without` some, and only with points that are closed."""
    shut = _shut_points(contacts)
    second = ~shut[:, 0]
    points, depths = contacts.points.copy(), contacts.depths.copy()
    points[second, 0], depths[second, 0] = points[second, 1], depths[second, 1]
    left = contacts._replace(touches=shut.sum(axis=1), points=points, depths=depths)
    stay: Booleans = np.asarray(shut.any(axis=1))
    stay[list(without)] = False
    return Contacts._make(field[stay] for field in left)


def _shut_points(contacts: Contacts) -> Booleans:
    """Return which points are closed: (c, 2)."""
    shut = (contacts.depths > -PROUD) & (np.arange(2) < contacts.touches[:, None])
    return np.asarray(shut, dtype=bool)


def rows_at(pose: Coordinates, joints: ExactJoints, found: Features) -> Rows:
    """Return all rows at given positions; those of joints as length to keep less present length."""
    first = len(joints.pulls_only)
    count = first + len(found.touching.rows)
    total, jacobian = np.empty(count), np.zeros((count, len(pose.values)))
    found.evaluate(pose, total[first:], jacobian[first:])
    if first:
        joints.equations.write_negative(pose, total[:first], jacobian[:first])
    return Rows(total, jacobian)


def _runs(contacts: Contacts, layout: Layout, running: Array) -> Array:
    rubs = layout.touching.friction_points
    if not np.count_nonzero(running):
        return np.zeros(len(rubs))
    a, b = layout.touching.friction_bodies
    runs = running[b] - running[a]
    direction = contacts.direction[layout.touching.pair[rubs]]
    return np.asarray(runs[:, 1] * direction[:, 0] - runs[:, 0] * direction[:, 1])
