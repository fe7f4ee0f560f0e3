"""Contacts of arcs and hoops with other shapes, exact on both sides.

pymunk's circles are filled. An arc is a line of some thickness along a part of a circle, so a shape
can touch it in three ways: from inside, with a corner or, if it is round, on the line from the
arc's centre through its own; from outside, as it would touch a disc; or at one of the two round
ends. pymunk is right about the last two, once it is known which of the three it is. Points of the
plane are complex numbers here.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

from sandbox.physics.geometry.outline_distance import dot, mean
from sandbox.physics.geometry.plane_curve import Side

Placed = tuple[complex, complex]
"""The position and rotation of a body: x + iy [m], cos + i sin."""

KEPT = 5e-7
"""m, the overlap of a body that follows an arc, which lets pymunk find the contact again. It is
below the overlap that is corrected."""
SOON = 0.125
"""The fraction by which a smaller overlap approaches `KEPT` in each step."""

Motion = tuple[complex, float]
"""The velocity and angular velocity of a body [m/s, rad/s]."""

THIN = 1e-4
"""The fraction of an arc's radius by which the middle of a shape may lie inside and still touch the
outer side: the middle of a thin line does, by the overlap that is not corrected."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A line of some thickness along a part of a circle, or along a whole circle as a hoop."""

    body: int
    """The body's index."""
    center: complex
    """The centre of the circle, in the axes of the body [m]."""
    radius: float
    """The radius of the circle, in the middle of the line [m]."""
    inner: float
    outer: float
    """The radii of the two sides [m]."""
    middle: complex
    """The direction from the centre to the middle of the arc, in the axes of the body."""
    cosine: float
    """The cosine of half the angle that it spans; below −1 for a whole circle."""

    def spans(self, offset: complex, rotation: complex) -> bool:
        """Return whether a vector from the centre points at the arc, with the body turned."""
        return dot(offset, self.middle * rotation) >= self.cosine * abs(offset)


@dataclass(frozen=True, slots=True)
class Piece:
    """One of pymunk's shapes, for contacts with arcs and curves."""

    body: int
    """The body's index."""
    core: tuple[complex, ...]
    """The corners before the radius is added, in the axes of the body; one point if round [m]."""
    radius: float
    """The thickness around the core [m]."""
    arc: Arc | None = None
    """The arc of which it is a side or an end; None for other shapes."""
    outward: complex = 0j
    """The outward direction of an arc's end; 0 for other shapes."""
    continuation: complex = 0j
    """The direction of another line that continues from an arc's end; 0 if there is none."""
    corner: complex | None = None
    """The corner or end [m] of a feeler, a shape that only touches arcs from inside; None for other
    shapes. The core of a feeler is that of the whole shape."""
    curve: Side | None = None
    """The side of a curve's stretch that it is; None for other shapes."""


class Touch(NamedTuple):
    """A contact of a corner or round shape with the inner side of an arc, or a side of a curve."""

    arc: Arc
    """The arc; for a curve, its osculating circle."""
    body: int
    """The index of the other body."""
    point: complex
    """The corner, or the centre of the round shape, in the axes of that body [m]."""
    radius: float
    """The radius around that point [m]."""
    depth: float
    """The overlap; negative if the two are apart [m]."""
    normal: complex
    """The unit vector from the arc to the other body."""
    on_arc: complex
    on_other: complex
    """The contact points on the two surfaces, in the plane [m]."""
    sign: int = 1
    """1 from inside, −1 from outside; 0 if the body does not follow the arc."""


class RelativeVelocity(NamedTuple):
    """The velocities of a body relative to an arc that it touches."""

    approach: float
    """The velocity of approach [m/s]."""
    separation: float
    """The velocity of separation needed to keep the overlap through the next drift; negative if the
    body may still come closer [m/s]."""
    along: float
    """The velocity along the arc [m/s]."""


Verdict = Touch | bool
"""A contact of two shapes: the touch; True for the one of pymunk; False for none."""


def verdict(one: Piece, other: Piece, pose: Placed, other_pose: Placed) -> Verdict:
    """Return the contact of two shapes, placed there, that overlap according to pymunk."""
    if _is_side(one) and _is_side(other):
        return _sides(one, other, pose, other_pose)
    if _is_side(one):
        return _at_side(one, other, pose, other_pose)
    if _is_side(other):
        return _at_side(other, one, other_pose, pose)
    return _at_end(one, other, pose, other_pose) and _at_end(other, one, other_pose, pose)


def relative_velocity(
    found: Touch,
    poses: tuple[Placed, Placed],
    motions: tuple[Motion, Motion],
    drift: float,
    before: float | None,
) -> RelativeVelocity:
    """Return the velocity of approach to an arc, and that of separation to follow it for a drift.

    A drift is straight, so a tangential one takes a body outwards by (v dt)² / 2r. It stays on the
    arc if it separates with v² dt / 2r, or approaches with as much from outside: then the
    velocities before and after a kick are along two chords, and their mean is tangential. The
    change of the tangential velocity in a kick is predicted from the last kick.

    `poses` and `motions` are those of the arc's body and of the other. `before` is the velocity
    along the arc a step ago [m/s]; None if the body did not follow the arc then.
    """
    (pose, other_pose), (rates, moves) = poses, motions
    offset = to_plane(other_pose, found.point) - to_plane(pose, found.arc.center)
    center, point = pose[1] * found.arc.center, other_pose[1] * found.point
    velocity = (moves[0] + 1j * moves[1] * point) - (rates[0] + 1j * rates[1] * center)
    bends = (rates[1] ** 2 * center - moves[1] ** 2 * point) * (drift / 2)
    out, distance = offset / abs(offset), abs(offset)
    along = dot(velocity + bends, 1j * out)
    slid = min(abs(along if before is None else 2 * along - before) * drift, distance)
    outwards = slid * slid / (distance + sqrt(distance * distance - slid * slid))
    nearer = min(max(KEPT - found.depth, 0.0) * SOON, outwards)
    comes = found.sign * dot(velocity, out)
    leaving = found.sign * (outwards / drift + dot(bends, out))
    return RelativeVelocity(comes, leaving - nearer / drift, along)


def _is_side(piece: Piece) -> bool:
    return piece.arc is not None and not piece.outward


def _at_side(side: Piece, other: Piece, pose: Placed, other_pose: Placed) -> Verdict:
    """Return the contact of an arc's side with a shape that is not such a side."""
    arc = side.arc
    assert arc is not None
    center = to_plane(pose, arc.center)
    if other.corner is None and len(other.core) > 1:
        return _is_outside(arc, other, center, pose[1], other_pose)
    point = other.core[0] if other.corner is None else other.corner
    offset = to_plane(other_pose, point) - center
    if not offset or not arc.spans(offset, pose[1]):
        return False
    if other.corner is None and abs(offset) >= arc.radius:
        return not other.outward or _ends_at(other, other_pose, center)
    if other.corner is None and other.outward:
        return False  # its feeler touches instead
    if other.corner is not None:
        middle = to_plane(other_pose, mean(other.core)) - center
        comes = _leaves(arc, middle, offset, pose[1])
        if not comes or _is_outside(arc, other, center, pose[1], other_pose):
            return False
    found = _inside(arc, center, other.body, point, other.radius, offset)
    if found.depth <= 0 or (other.outward and not _ends_at(other, other_pose, center + 2 * offset)):
        return False
    return found


def _leaves(arc: Arc, start: complex, end: complex, rotation: complex) -> bool:
    """Return whether the way between two points, seen from the centre, leads out through an arc."""
    if dot(start, end) >= arc.radius * abs(end):
        return False
    if abs(end) <= arc.radius:
        return True
    offset = end - start
    ahead, square = dot(start, offset), dot(offset, offset)
    root = ahead * ahead - square * (dot(start, start) - arc.radius**2)
    fraction = (sqrt(root) - ahead) / square if root > 0 else 0.0
    return fraction > 0 and arc.spans(start + fraction * offset, rotation)


def _inside(
    arc: Arc, center: complex, body: int, point: complex, radius: float, offset: complex
) -> Touch:
    """Return the contact of a round point, at `offset` from an arc's centre, from inside."""
    out = offset / abs(offset)
    on_arc, on_other = center + arc.inner * out, center + offset + radius * out
    depth = abs(offset) + radius - arc.inner
    return Touch(arc, body, point, radius, depth, -out, on_arc, on_other)


def _is_outside(
    arc: Arc, other: Piece, center: complex, rotation: complex, other_pose: Placed
) -> bool:
    """Return whether a shape with corners is at the outer side of an arc.

    The arc spans the direction of its point nearest to the centre, and its middle is beyond the
    arc's radius in that direction.
    """
    core = [to_plane(other_pose, corner) for corner in other.core]
    offset = nearest(core, center) - center
    if not offset or not arc.spans(offset, rotation):
        return False
    beyond = dot(mean(core) - center, offset) / abs(offset)
    return beyond > arc.radius * (1 - THIN)


def _sides(one: Piece, other: Piece, pose: Placed, other_pose: Placed) -> Verdict:
    """Return the contact of the sides of two arcs, one inside the other or both from outside."""
    wide, narrow = one.arc, other.arc
    assert wide is not None
    assert narrow is not None
    if wide.radius < narrow.radius:
        return _sides(other, one, other_pose, pose)
    center = to_plane(pose, wide.center)
    offset = to_plane(other_pose, narrow.center) - center
    if abs(offset) >= wide.radius:
        return wide.spans(offset, pose[1]) and narrow.spans(-offset, other_pose[1])
    if not offset or not (wide.spans(offset, pose[1]) and narrow.spans(offset, other_pose[1])):
        return False
    found = _inside(wide, center, narrow.body, narrow.center, narrow.outer, offset)
    return found if found.depth > 0 else False


def _at_end(end: Piece, other: Piece, pose: Placed, other_pose: Placed) -> bool:
    """Return whether a shape can touch another that may be the end of an arc.

    An end is touched only from beyond it: a shape beside the arc touches the arc's side, and one
    beside a line that continues the arc touches that line.
    """
    if not end.outward:
        return True
    if len(other.core) > 1:
        core = [to_plane(other_pose, corner) for corner in other.core]
        return _ends_at(end, pose, nearest(core, to_plane(pose, end.core[0])))
    point = to_plane(other_pose, other.core[0])
    if end.arc is None:
        return _ends_at(end, pose, point)
    if end.arc.spans(point - to_plane(pose, end.arc.center), pose[1]):
        return False
    return not end.continuation or _ends_at(end, pose, point)


def _ends_at(end: Piece, pose: Placed, point: complex) -> bool:
    """Return whether a point is beyond an arc's end, and not beside a line that continues it."""
    offset = point - to_plane(pose, end.core[0])
    return dot(offset, end.outward * pose[1]) >= 0 and dot(offset, end.continuation * pose[1]) <= 0


def to_plane(other_pose: Placed, point: complex) -> complex:
    """Return the position of a body's point in the plane [m]."""
    return other_pose[0] + other_pose[1] * point


def nearest(core: Sequence[complex], point: complex) -> complex:
    """Return the point of a convex core nearest to a place; the place itself if it is inside."""
    best, within = core[0], len(core) > 2
    if len(core) == 1:
        return best
    for i, b in enumerate(core):
        a = core[i - 1]
        along = b - a
        fraction = dot(point - a, along) / (dot(along, along) or 1.0)  # far out, ends may coincide
        foot = a + along * min(max(fraction, 0.0), 1.0)
        if abs(foot - point) < abs(best - point):
            best = foot
        within &= along.real * (point - a).imag - along.imag * (point - a).real > 0
    return point if within else best
