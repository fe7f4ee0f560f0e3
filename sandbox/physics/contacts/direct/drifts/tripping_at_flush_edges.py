"""Bodies that come from one surface onto a flush next one, and do not trip over its edge.

A resting body sits a little deeper in the skin of a surface than where a contact is first detected.
So a box that slides from one table onto the next, or a wheel that rolls there, seems to hit its
edge.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import permutations
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import BodyMotion, Hit, Path
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift
from sandbox.physics.contacts.direct.prediction.separation_bound import spread
from sandbox.physics.geometry.outline_distance import Outline, dot, gap

LEVEL = 1e-6
"""m, the highest step between flush surfaces, as by rounded decimals."""

BESIDE = 1e-3
"""m, the largest distance between the contact on the old surface and the point met on the new."""

THERE = 1e-4
"""m: within this distance along a surface it is checked whether it rises."""

FACES = 0.5
"""The least cosine between the normals of flush surfaces, if one is an arc or a curve."""

ON = 1e-8
"""m, the largest distance of a point of contact from the shape on which it is."""

Shapes = Callable[[int], Sequence[Outline]]
"""Returns the outlines of the shapes of a body."""


class _Ground(NamedTuple):
    """A point of the surface on which a body lies that meets another one.

    The unit normal points towards the body on it; the point is in the plane [m].
    """

    normal: complex
    point: complex


def carries_on(part: Subdrift, path: Path, hit: Hit, shapes: Shapes) -> bool:
    """Return whether a hit is only the passage of a body onto a flush continuation of its support.

    `part` and `path` are a part of a drift, and the motion in it; `hit` is an impact in it.
    `shapes` returns the outlines of bodies other than curves.
    """
    bodies, gaps = part.kick.layout.touching.bodies, part.kick.layout.gaps
    bears = {frozenset(pair) for pair in bodies[:, part.forces[gaps] > 0].T.tolist()}
    for guest, other in permutations(hit.bodies):
        grounds = {next(iter(pair - {guest})) for pair in bears if guest in pair} - {other}
        still = {body for body in grounds if _goes_with(body, other, path, hit, part.drift)}
        if still and any(
            _is_level(ground, other, path, hit, shapes)
            for ground in _grounds(part, path.pose_at(hit.time), guest, still)
        ):
            return True
    return False


def _goes_with(body: int, other: int, path: Path, hit: Hit, duration: float) -> bool:
    """Return whether two bodies move alike at a hit for a time [s]."""
    motion, other_motion = (BodyMotion(path, one, hit.time) for one in (body, other))
    relative_path = (
        max(
            abs(other_motion.velocity_at(point) - motion.velocity_at(point)) for point in hit.points
        )
        * duration
    )
    return relative_path <= LEVEL


def _grounds(part: Subdrift, pose: Array, guest: int, bodies: set[int]) -> Iterator[_Ground]:
    """Yield the points of the surfaces of some bodies on which another one lies at a place."""
    contacts = part.kick.contacts_at(spread(pose))
    points = np.ascontiguousarray(contacts.points).view(complex)[..., 0] - part.kick.joints.origin
    for row, pair in enumerate(contacts.bodies.tolist()):
        if guest in pair and not bodies.isdisjoint(pair):
            normal = complex(*contacts.direction[row]) * (1 if pair[1] == guest else -1)
            for number in range(int(contacts.touches[row])):
                depth = float(contacts.depths[row, number])
                yield _Ground(normal, complex(points[row, number]) + normal * depth / 2)


def _is_level(ground: _Ground, other: int, path: Path, hit: Hit, shapes: Shapes) -> bool:
    """Return whether a body does not rise above a surface where it is met."""
    n, other_motion = ground.normal, BodyMotion(path, other, hit.time)
    faces = dot(n, hit.normal if hit.bodies[0] == other else -hit.normal) > FACES
    cores = [(other_motion.place(one.corners), one.radius) for one in shapes(other)]
    for point in hit.points:
        height = dot(n, point - ground.point)
        met = [(core, half) for core, half in cores if gap(core, (point,), half).distance < ON]
        offsets = [corner + half * n - point for core, half in met for corner in core]
        tops = [height + dot(n, offset) / max(1.0, abs(offset) / THERE) for offset in offsets]
        if abs(point - ground.point) > BESIDE or not (tops or faces):
            return False
        if max(tops or [abs(height)]) > LEVEL:
            return False
    return True
