"""The contact forces on one body: normal force, friction, and their points of application.

The direct solver yields the impulse at every contact point, so the line of action of a force of one
side on another is known. pymunk yields only the sum for both points of a side: the point of
application between them follows from the angular acceleration of the body.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.contacts.coefficients.static_friction import BreakawayImpulse
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.measuring.free_body import FRICTION, NORMAL, AppliedForce


class ContactForce(NamedTuple):
    """The forces of a contact on a body."""

    row: int
    """The index of the other body."""
    normal: Array
    friction: Array
    """(3,) each, the force [N], and the torque about the centre of mass as far as known [N m]."""
    at: Array
    """(2,), the middle of the contact [m]."""
    half: Array
    """(2,), from the middle to one of two contact points, if the force may act anywhere between
    them [m]."""

    def acting(self, by: str, center: XY) -> Iterator[AppliedForce]:
        """Yield the two forces on a body, given its centre of mass [m]."""
        for name, (x, y, torque) in ((NORMAL, self.normal), (FRICTION, self.friction)):
            force, square = (float(x), float(y)), float(x * x + y * y)
            if square:
                arm = self.at - center
                shift = (
                    torque - (arm[0] * y - arm[1] * x)
                ) / square  # offset of the line of action
                foot = float(arm[0] + shift * y), float(arm[1] - shift * x)
                yield AppliedForce.of(name, by, force, float(torque), center, foot)


def forces_of_contacts(
    contacts: Contacts, wrenches: Array | None, row: int, center: Array, length: float
) -> Iterator[ContactForce]:
    """Yield the forces of each of the k contacts on a body in a kick of some length [s].

    `wrenches` are the normal and friction impulses on the body [N s, N m s], (2, k, 3), if known
    per contact. `row` is the index of the body, `center` its centre of mass, (2,) [m].
    """
    ours = (contacts.bodies == row).any(axis=1) & contacts.impulse.any(axis=1)
    for pair in np.flatnonzero(ours).tolist():
        second = int(contacts.bodies[pair, 1] == row)
        both = contacts.touches[pair] == 2
        points = contacts.points[pair, : 1 + both]
        at = points.mean(axis=0)
        if wrenches is not None:
            normal, friction = wrenches[:, pair] / length
            half = np.zeros(2)
        else:
            half = (points[1] - at) if both else np.zeros(2)
            at = contacts.on_surfaces(_middles(contacts))[pair, second]
            normal, friction = _parts(contacts, pair, (2 * second - 1) / length, at - center)
        yield ContactForce(int(contacts.bodies[pair, 1 - second]), normal, friction, at, half)


def with_breakaway(
    contact_forces: Sequence[ContactForce],
    breakaways: Iterable[tuple[int, BreakawayImpulse]],
    row: int,
    center: Array,
    length: float,
) -> Sequence[ContactForce]:
    """Return the contacts with the friction that is left where one broke loose within the kick.

    pymunk does not know that its friction was lowered after it. `breakaways` has the index of the
    other body with each reduction; the others are those of `forces_of_contacts`.
    """
    reduced = list(contact_forces)
    for other, (body, impulse, points) in breakaways:
        sign, at = (1, points[0]) if body == row else (-1, points[1])
        force, arm = sign * np.array(impulse) / length, np.array(at) - center
        wrench = np.append(force, arm[0] * force[1] - arm[1] * force[0])
        candidates = [
            (float(np.hypot(*(p.at - at))), i) for i, p in enumerate(reduced) if p.row == other
        ]
        if candidates:
            _, i = min(candidates)
            reduced[i] = reduced[i]._replace(friction=reduced[i].friction + wrench)
    return reduced


def with_torque(contact_forces: Sequence[ContactForce], missing: float) -> Sequence[ContactForce]:
    """Return the contacts with their forces moved along the sides that they act on.

    Together they then supply the missing torque [N m]. Each force is moved as little as possible,
    and not beyond the ends of its side.
    """
    levers = np.array([p.half[0] * p.normal[1] - p.half[1] * p.normal[0] for p in contact_forces])
    fractions = np.zeros(len(contact_forces))
    for _ in contact_forces:  # a force at an end leaves the rest to the others
        movable = np.where(np.abs(fractions) < 1, levers, 0.0)
        if square := float(movable @ movable):
            remaining = missing - float(fractions @ levers)
            fractions = np.clip(fractions + remaining * movable / square, -1.0, 1.0)
    turning = np.outer(fractions * levers, (0.0, 0.0, 1.0))
    return [
        press._replace(at=press.at + fraction * press.half, normal=press.normal + turned)
        for press, fraction, turned in zip(contact_forces, fractions, turning, strict=True)
    ]


def _middles(contacts: Contacts) -> Array:
    """Return the middle of each contact: (k, 2) [m]."""
    second = np.where(contacts.touches == 2, 1, 0)
    both = contacts.points[np.arange(len(second)), second]
    return (contacts.points[:, 0] + both) / 2


def _parts(contacts: Contacts, pair: int, scale: float, arm: Array) -> tuple[Array, Array]:
    """Return the normal force of a pair and its friction, with their torques: (3,) each."""
    force, direction = contacts.impulse[pair] * scale, contacts.direction[pair]
    normal = (force @ direction) * direction
    both = np.stack((normal, force - normal))
    torque = arm[0] * both[:, 1] - arm[1] * both[:, 0]
    wrenches = np.column_stack((both, torque))
    return wrenches[0], wrenches[1]
