"""The contact forces on one body: normal force, friction, and where they act.

Contacts that are solved directly tell the impulse at every point, so the force of a side on a side
is known with its line of action. pymunk tells the impulse of both points of a side together: where
between them it acts follows from how the body turns, and lies between them if all is well.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.measuring.free_body import FRICTION, NORMAL, Acting


class Press(NamedTuple):
    """What a contact does to a body.

    Attributes
    ----------
    row
        The other body's.
    normal, friction
        Forces [N], and torques about the centre of mass as far as they are told [N m]: (3,) each.
    at
        The middle of where they touch: (2,) [m].
    half
        From there to the point at which they touch as well, if the force may act anywhere between:
        (2,) [m].
    """

    row: int
    normal: Array
    friction: Array
    at: Array
    half: Array

    def acting(self, by: str, center: XY) -> Iterator[Acting]:
        """Yield the two forces, on a body with its centre of mass at a point [m]."""
        for name, (x, y, torque) in ((NORMAL, self.normal), (FRICTION, self.friction)):
            force, square = (float(x), float(y)), float(x * x + y * y)
            if square:
                arm = self.at - center
                off = (torque - (arm[0] * y - arm[1] * x)) / square  # to its line of action
                foot = float(arm[0] + off * y), float(arm[1] - off * x)
                yield Acting.of(name, by, force, float(torque), center, foot)


def presses(
    contacts: Contacts, wrenches: Array | None, row: int, place: Array, length: float
) -> Iterator[Press]:
    """Yield what each contact does to a body in a kick.

    Parameters
    ----------
    contacts
        Those of the kick; k of them.
    wrenches
        (2, k, 3), its impulses on the body as far as they are known by themselves [N s, N m s].
    row, place
        Which body, and where its centre of mass is: (2,) [m].
    length
        How long the kick is [s].
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
            normal, friction = _parts(contacts, pair, (2 * second - 1) / length, at - place)
        yield Press(int(contacts.bodies[pair, 1 - second]), normal, friction, at, half)


def settled(found: Sequence[Press], missing: float) -> Sequence[Press]:
    """Return the same with the forces moved along the sides that they act on.

    Together they give a torque [N m] that is missing; of several sides each is moved as little as
    it can be, and none beyond its ends.
    """
    levers = np.array([p.half[0] * p.normal[1] - p.half[1] * p.normal[0] for p in found])
    shares = np.zeros(len(found))
    for _ in found:  # what one cannot give at its end is left to the others
        free = np.where(np.abs(shares) < 1, levers, 0.0)
        if square := float(free @ free):
            missed = missing - float(shares @ levers)
            shares = np.clip(shares + missed * free / square, -1.0, 1.0)
    turning = np.outer(shares * levers, (0.0, 0.0, 1.0))
    return [
        press._replace(at=press.at + share * press.half, normal=press.normal + turned)
        for press, share, turned in zip(found, shares, turning, strict=True)
    ]


def _middles(contacts: Contacts) -> Array:
    """Return the middle of where each pair touches: (k, 2) [m]."""
    second = np.where(contacts.touches == 2, 1, 0)
    both = contacts.points[np.arange(len(second)), second]
    middles: Array = (contacts.points[:, 0] + both) / 2
    return middles


def _parts(contacts: Contacts, pair: int, scale: float, arm: Array) -> tuple[Array, Array]:
    """Return the normal force of a pair and its friction, with their torques: (3,) each."""
    force, direction = contacts.impulse[pair] * scale, contacts.direction[pair]
    normal = (force @ direction) * direction
    both = np.stack((normal, force - normal))
    torque = arm[0] * both[:, 1] - arm[1] * both[:, 0]
    whole = np.column_stack((both, torque))
    return whole[0], whole[1]
