"""Corners that meet corners keep their normal.

Where a corner touches a corner, the normal is not unique: a whole cone of directions is possible.
pymunk takes the line between the centres of the two roundings, of 1e-8 m. This line turns with the
smallest error of a position, and flips to the normal of a side where the roundings overlap. The
forces would turn with it and move bodies at rest. Any normal of the cone will do. So the first one
is kept, as if it were that of a side of the first body, until the corners slip or turn against
each other.
"""

from typing import NamedTuple

import numpy as np

from sandbox.physics.contacts.direct.rows.contact_outlines import PARALLEL
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.joints.exact.constraint_interface import Coordinates

REACH = 1e-7
"""m: corners keep their normal until they have slipped by this, some of their roundings."""


class CornerPair(NamedTuple):
    """Two corners that meet.

    The points are along the axes of the first body and of the second [m]. The normal is from the
    first to the second, along the axes of the first; `relative_angle` is the angle of the second
    relative to the first [rad].
    """

    points: tuple[complex, complex]
    normal: complex
    relative_angle: float


class CornerPairs:
    """Remembers corners that meet from step to step."""

    def __init__(self) -> None:
        self._held: dict[tuple[int, int], CornerPair] = {}

    def forget(self) -> None:
        """Forget all pairs: bodies were put elsewhere."""
        self._held = {}

    def note(self, kick: Kick) -> None:
        """Remember the pairs of a kick; known ones keep their normal."""
        corners, before, self._held = kick.features.corners, self._held, {}
        if corners is None:
            return
        touching, features = kick.layout.touching, kick.features
        for gap in np.flatnonzero(corners).tolist():
            a, b = touching.bodies[:, gap].tolist()
            if kick.contacts.touches[touching.pair[gap]] == 1:
                one, other = features.points[:, gap].tolist()
                relative_angle = float(kick.pose.angle[b] - kick.pose.angle[a])
                new = CornerPair((one, other), complex(features.normal[gap]), relative_angle)
                self._held[a, b] = before.get((a, b), new)

    def with_kept_normals(self, contacts: Contacts, pose: Coordinates, origin: complex) -> Contacts:
        """Return the contacts with the remembered normals of corner pairs.

        `pose` has the positions of the bodies, and `origin` is the origin of these [m].
        """
        if not self._held:
            return contacts
        touches, direction = contacts.touches.copy(), contacts.direction.copy()
        points, depths = contacts.points.copy(), contacts.depths.copy()
        for row, (a, b) in enumerate(contacts.bodies.tolist()):
            if kept := self._held.get((a, b)):
                n = kept.normal * complex(pose.rotation[a])
                first, second = (
                    complex(pose.position[body] + point * pose.rotation[body])
                    for body, point in zip((a, b), kept.points, strict=True)
                )
                off = (second - first) * n.conjugate()
                turn = float(pose.angle[b] - pose.angle[a]) - kept.relative_angle
                if abs(off.imag) > REACH or abs(turn) > PARALLEL:
                    del self._held[a, b]
                    continue
                middle = (first + second) / 2 + origin
                touches[row], direction[row], depths[row, 0] = 1, (n.real, n.imag), -off.real
                points[row, 0] = middle.real, middle.imag
        return contacts._replace(touches=touches, direction=direction, points=points, depths=depths)
