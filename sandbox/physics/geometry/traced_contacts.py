"""Contacts with arcs and curves, traced to other positions of their bodies."""

from collections.abc import Callable
from typing import NamedTuple

from sandbox.physics.geometry.arc_contacts import Piece, Placed, Touch, to_plane
from sandbox.physics.geometry.outline_distance import Outline, dot, gap
from sandbox.physics.geometry.plane_curve import Side


class ContactGeometry(NamedTuple):
    """The points of two surfaces that meet in a contact.

    `normal` is the unit normal from the first surface, which is the arc or curve if one is met from
    inside; `tip` is the point of the other body, and `gap` its distance from the first surface,
    negative beyond it [m].
    """

    normal: complex
    tip: complex
    gap: float


Trace = Callable[[Placed, Placed], ContactGeometry]
"""A contact, given the positions and rotations of the hollow body and the other one."""


def trace(touch: Touch, hollow: Piece, other: Piece, at: Placed, there: Placed) -> Trace:
    """Return a contact as a function of the positions of its bodies.

    `at` and `there` are their positions and rotations at the contact.
    """
    if hollow.curve is None:
        return lambda at, there: _in_arc(touch, at, there)
    if other.corner is None and len(other.core) > 1:
        return _side_on_curve(hollow.curve, -touch.normal / there[1], touch, there)
    return _on_curve(hollow.curve, touch, at, there)


def trace_convex(one: Outline, other: Outline) -> Trace:
    """Return the contact of two convex outlines, one of which is a disc."""

    def found(at: Placed, there: Placed) -> ContactGeometry:
        cores = (
            [to_plane(at, corner) for corner in one.corners],
            [to_plane(there, p) for p in other.corners],
        )
        apart, normal, points = gap(*cores, one.radius + other.radius)
        return ContactGeometry(normal, points[0] + normal * (one.radius + apart), apart)

    return found


def _in_arc(touch: Touch, at: Placed, there: Placed) -> ContactGeometry:
    """Return the contact of a point, with a radius around it, with an arc from inside."""
    center = to_plane(at, touch.arc.center)
    way = to_plane(there, touch.point) - center
    out = way / abs(way)
    return ContactGeometry(
        -out, center + way + touch.radius * out, touch.arc.inner - abs(way) - touch.radius
    )


def _on_curve(side: Side, touch: Touch, at: Placed, there: Placed) -> Trace:
    """Return the contact of a point, with a radius around it, with a curve."""

    def seen(at: Placed, there: Placed) -> complex:
        return (to_plane(there, touch.point) - at[0]) / at[1]

    start = side.course.foot_point(seen(at, there), side.stretch)
    assert start
    hand = 1 if dot(touch.normal / at[1], 1j * start.tangent) >= 0 else -1

    def found(at: Placed, there: Placed) -> ContactGeometry:
        place = seen(at, there)
        foot = side.course.foot_point_near(place, start.parameter)
        out = hand * 1j * foot.tangent
        gap = dot(place - foot.point, out) - side.half - touch.radius
        return ContactGeometry(out * at[1], to_plane(at, place - out * touch.radius), gap)

    return found


def _side_on_curve(side: Side, out: complex, touch: Touch, there: Placed) -> Trace:
    """Return the contact of a straight side with a curve.

    `out` is the unit normal of the straight side, along the axes of its body.
    """
    place = (touch.on_other - there[0]) / there[1]

    def found(at: Placed, there: Placed) -> ContactGeometry:
        away = out * there[1] / at[1]
        point = side.course.lowest(away, side.stretch)
        high = dot(point - (to_plane(there, place) - at[0]) / at[1], away)
        return ContactGeometry(-away * at[1], to_plane(at, point - high * away), high - side.half)

    return found
