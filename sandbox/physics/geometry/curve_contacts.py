"""Contacts of curves with other shapes, exact on both sides.

In pymunk each stretch of a curve is a filled circle around it, so that every possible contact is
found. A round body touches the curve at the point nearest to its centre, and a corner at the point
nearest to the corner. A straight side touches it from outside, where the curve is parallel to the
side. Points of the plane are complex numbers here.
"""

from collections.abc import Iterator
from weakref import WeakKeyDictionary

import numpy as np

from sandbox.model.expressions import Values
from sandbox.model.level_parts import names_in
from sandbox.model.shapes import Curve
from sandbox.model.wire_points import along
from sandbox.physics.geometry import arc_contacts
from sandbox.physics.geometry.arc_contacts import THIN, Arc, Piece, Placed, Touch, Verdict, to_plane
from sandbox.physics.geometry.outline_distance import dot, mean
from sandbox.physics.geometry.plane_curve import CurvePoint, MiddleLine, Side

CENTRED = 1e-3
"""The smallest distance from the centre of curvature, over the radius of curvature, at which a body
inside a curve is followed."""

DEEP = 0.5
"""The largest overlap of a straight side with a curve, over the width of its shape, that counts as
a contact."""


_MIDDLE_LINES: WeakKeyDictionary[Curve, tuple[tuple[float, ...], MiddleLine]] = WeakKeyDictionary()
"""The last middle line of each curve of the levels in use, and the values of its parameters.

A scene needs each several times, and each takes some 0.5 MB."""


def middle_line_of(curve: Curve, values: Values) -> MiddleLine:
    """Return the middle line of a curve, in the axes of its body."""
    key = tuple(values[name] for name in sorted(names_in(curve) - {"s"}))
    old_key, middle_line = _MIDDLE_LINES.get(curve, (None, None))
    if middle_line is None or key != old_key:
        middle_line = MiddleLine(along(curve, values))
        _MIDDLE_LINES[curve] = key, middle_line
    return middle_line


def verdict(one: Piece, other: Piece, pose: Placed, other_pose: Placed) -> Verdict:
    """Return the contact of two shapes, placed there, that overlap according to pymunk."""
    if one.curve:
        return _touch(one.curve, other, pose, other_pose)
    if other.curve:
        return _touch(other.curve, one, other_pose, pose)
    return arc_contacts.verdict(one, other, pose, other_pose)


def closest_circle(foot: CurvePoint, half: float, body: int) -> Arc:
    """Return the osculating circle of a middle line at a point, as an arc of thickness 2 `half`."""
    radius = 1 / abs(foot.curvature)
    center = foot.point + 1j * foot.tangent / foot.curvature
    return Arc(body, center, radius, radius - half, radius + half, 1 + 0j, -2.0)


def _touch(side: Side, other: Piece, pose: Placed, other_pose: Placed) -> Verdict:
    core = [(to_plane(other_pose, corner) - pose[0]) / pose[1] for corner in other.core]
    middle = mean(core)
    if other.corner is None and len(core) > 1:
        return _flat(side, other, core, pose)
    point = (
        middle if other.corner is None else (to_plane(other_pose, other.corner) - pose[0]) / pose[1]
    )
    knot_index, knot = side.middle_line.nearest_knot(point, side.stretch)
    if _is_far(side, other.radius, point - knot, middle - point):
        return False
    foot = side.middle_line.foot_point(point, side.stretch, knot_index)
    if foot is None:
        return False
    left = 1j * foot.tangent
    sign = 1 if dot(middle - foot.point, left) >= 0 else -1
    distance = sign * dot(point - foot.point, left)
    depth = side.half + other.radius - distance
    if depth <= 0 or (other.corner is not None and depth > abs(middle - point) + other.radius):
        return False
    inside = sign * foot.curvature > 0
    center = distance * abs(foot.curvature) > 1 - CENTRED if inside else False
    return Touch(
        arc=closest_circle(foot, side.half, side.body),
        body=other.body,
        point=other.core[0] if other.corner is None else other.corner,
        radius=other.radius,
        depth=depth,
        normal=sign * left * pose[1],
        on_arc=to_plane(pose, foot.point + sign * left * side.half),
        on_other=to_plane(pose, point - sign * left * other.radius),
        sign=0 if center else 1 if inside else -1,
    )


def _is_far(side: Side, radius: float, offset: complex, to_middle: complex) -> bool:
    """Return whether a point is surely too far from a stretch to touch it, without its foot point.

    `offset` and `to_middle` lead from the nearest knot to the point, and on to its shape's middle
    [m].
    """
    distance, spacing = abs(offset), side.middle_line.spacing
    least_distance = distance - spacing
    if least_distance <= side.half + radius:
        return False
    # the largest angle between the vectors from foot and knot
    largest_turn = 2 * spacing / distance
    # whether both are on the same side
    return least_distance + dot(to_middle, offset) / distance > abs(to_middle) * largest_turn


def _flat(side: Side, other: Piece, core: list[complex], pose: Placed) -> Verdict:
    """Return the contact of a shape's straight sides with a stretch, from outside."""
    best: Touch | None = None
    for a, b in _edges(core):
        out = -1j * (b - a) / abs(b - a)
        foot = side.middle_line.parallel(-side.stretch.turn_sign * 1j * out, side.stretch)
        if foot is None:
            continue
        depth = side.half + other.radius - dot(foot.point - a, out)
        deepest = max(DEEP * max(dot(a - c, out) for c in core), THIN / abs(foot.curvature))
        projection = dot(foot.point - a, b - a)
        beside = 0 < projection < dot(b - a, b - a)
        if beside and 0 < depth < deepest and (best is None or depth < best.depth):
            on_other = a + (b - a) * projection / dot(b - a, b - a) + out * other.radius
            best = Touch(
                arc=closest_circle(foot, side.half, side.body),
                body=other.body,
                point=0j,
                radius=other.radius,
                depth=depth,
                normal=-out * pose[1],
                on_arc=to_plane(pose, foot.point - out * side.half),
                on_other=to_plane(pose, on_other),
                sign=0,
            )
    return best or False


def _edges(core: list[complex]) -> Iterator[tuple[complex, complex]]:
    """Yield the edges of a core counter-clockwise; a segment has two, one in each direction."""
    corners = np.array(core)
    around = float((corners.conj() * np.roll(corners, -1)).imag.sum())
    for i, b in enumerate(core):
        yield (core[i - 1], b) if around >= 0 else (b, core[i - 1])
