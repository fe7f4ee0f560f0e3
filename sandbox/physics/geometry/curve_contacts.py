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
from sandbox.physics.geometry.plane_curve import Course, CurvePoint, Side

CENTRED = 1e-3
"""The smallest distance from the centre of curvature, over the radius of curvature, at which a body
inside a curve is followed."""

DEEP = 0.5
"""The largest overlap of a straight side with a curve, over the width of its shape, that counts as
a contact."""


_COURSES: WeakKeyDictionary[Curve, tuple[tuple[float, ...], Course]] = WeakKeyDictionary()
"""The last course of each curve of the levels that are in use, and the values of its parameters: a
scene needs each several times, and each takes some 0.5 MB."""


def course_of(curve: Curve, values: Values) -> Course:
    """Return the course of a curve, in the axes of its body."""
    chosen = tuple(values[name] for name in sorted(names_in(curve) - {"s"}))
    before, course = _COURSES.get(curve, (None, None))
    if course is None or chosen != before:
        course = Course(along(curve, values))
        _COURSES[curve] = chosen, course
    return course


def verdict(one: Piece, other: Piece, at: Placed, there: Placed) -> Verdict:
    """Return the contact of two shapes, placed there, that overlap according to pymunk."""
    if one.curve:
        return _touch(one.curve, other, at, there)
    if other.curve:
        return _touch(other.curve, one, there, at)
    return arc_contacts.verdict(one, other, at, there)


def closest_circle(foot: CurvePoint, half: float, body: int) -> Arc:
    """Return the osculating circle of a course at a point, as an arc of thickness 2 `half`."""
    radius = 1 / abs(foot.curvature)
    center = foot.point + 1j * foot.tangent / foot.curvature
    return Arc(body, center, radius, radius - half, radius + half, 1 + 0j, -2.0)


def _touch(side: Side, other: Piece, at: Placed, there: Placed) -> Verdict:
    core = [(to_plane(there, corner) - at[0]) / at[1] for corner in other.core]
    middle = mean(core)
    if other.corner is None and len(core) > 1:
        return _flat(side, other, core, at)
    point = middle if other.corner is None else (to_plane(there, other.corner) - at[0]) / at[1]
    near, knot = side.course.nearest_knot(point, side.stretch)
    if _is_far(side, other.radius, point - knot, middle - point):
        return False
    foot = side.course.foot_point(point, side.stretch, near)
    if foot is None:
        return False
    left = 1j * foot.tangent
    hand = 1 if dot(middle - foot.point, left) >= 0 else -1
    apart = hand * dot(point - foot.point, left)
    depth = side.half + other.radius - apart
    if depth <= 0 or (other.corner is not None and depth > abs(middle - point) + other.radius):
        return False
    inside = hand * foot.curvature > 0
    center = apart * abs(foot.curvature) > 1 - CENTRED if inside else False
    return Touch(
        arc=closest_circle(foot, side.half, side.body),
        body=other.body,
        point=other.core[0] if other.corner is None else other.corner,
        radius=other.radius,
        depth=depth,
        normal=hand * left * at[1],
        on_arc=to_plane(at, foot.point + hand * left * side.half),
        on_other=to_plane(at, point - hand * left * other.radius),
        sign=0 if center else 1 if inside else -1,
    )


def _is_far(side: Side, radius: float, way: complex, inwards: complex) -> bool:
    """Return whether a point is surely too far from a stretch to touch it, without its foot point.

    `way` and `inwards` lead from the nearest knot to the point, and on to its shape's middle [m].
    """
    far, spacing = abs(way), side.course.spacing
    least = far - spacing
    if least <= side.half + radius:
        return False
    turned = 2 * spacing / far  # the largest angle between the vectors from foot and knot
    return least + dot(inwards, way) / far > abs(inwards) * turned  # both are on the same side


def _flat(side: Side, other: Piece, core: list[complex], at: Placed) -> Verdict:
    """Return the contact of a shape's straight sides with a stretch, from outside."""
    best: Touch | None = None
    for a, b in _edges(core):
        out = -1j * (b - a) / abs(b - a)
        foot = side.course.parallel(-side.stretch.turn_sign * 1j * out, side.stretch)
        if foot is None:
            continue
        depth = side.half + other.radius - dot(foot.point - a, out)
        wide = max(DEEP * max(dot(a - c, out) for c in core), THIN / abs(foot.curvature))
        share = dot(foot.point - a, b - a)
        beside = 0 < share < dot(b - a, b - a)
        if beside and 0 < depth < wide and (best is None or depth < best.depth):
            on_other = a + (b - a) * share / dot(b - a, b - a) + out * other.radius
            best = Touch(
                arc=closest_circle(foot, side.half, side.body),
                body=other.body,
                point=0j,
                radius=other.radius,
                depth=depth,
                normal=-out * at[1],
                on_arc=to_plane(at, foot.point - out * side.half),
                on_other=to_plane(at, on_other),
                sign=0,
            )
    return best or False


def _edges(core: list[complex]) -> Iterator[tuple[complex, complex]]:
    """Yield the edges of a core counter-clockwise; a segment has two, one in each direction."""
    corners = np.array(core)
    around = float((corners.conj() * np.roll(corners, -1)).imag.sum())
    for i, b in enumerate(core):
        yield (core[i - 1], b) if around >= 0 else (b, core[i - 1])
