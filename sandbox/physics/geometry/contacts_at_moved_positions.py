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


def trace(touch: Touch, hollow: Piece, other: Piece, pose: Placed, other_pose: Placed) -> Trace:
    """Return a contact as a function of the positions of its bodies.

    `pose` and `other_pose` are their positions and rotations at the contact.
    """
    if hollow.curve is None:
        return lambda pose, other_pose: _in_arc(touch, pose, other_pose)
    if other.corner is None and len(other.core) > 1:
        return _side_on_curve(hollow.curve, -touch.normal / other_pose[1], touch, other_pose)
    return _on_curve(hollow.curve, touch, pose, other_pose)


def trace_convex(one: Outline, other: Outline) -> Trace:
    """Return the contact of two convex outlines, one of which is a disc."""

    def contact_at(pose: Placed, other_pose: Placed) -> ContactGeometry:
        cores = (
            [to_plane(pose, corner) for corner in one.corners],
            [to_plane(other_pose, p) for p in other.corners],
        )
        distance, normal, points = gap(*cores, one.radius + other.radius)
        return ContactGeometry(normal, points[0] + normal * (one.radius + distance), distance)

    return contact_at


def _in_arc(touch: Touch, pose: Placed, other_pose: Placed) -> ContactGeometry:
    """Return the contact of a point, with a radius around it, with an arc from inside."""
    center = to_plane(pose, touch.arc.center)
    offset = to_plane(other_pose, touch.point) - center
    outward = offset / abs(offset) if offset else 1j  # at the center any direction is as near
    return ContactGeometry(
        -outward,
        center + offset + touch.radius * outward,
        touch.arc.inner - abs(offset) - touch.radius,
    )


def _on_curve(side: Side, touch: Touch, pose: Placed, other_pose: Placed) -> Trace:
    """Return the contact of a point, with a radius around it, with a curve."""

    def point_in_axes(pose: Placed, other_pose: Placed) -> complex:
        return (to_plane(other_pose, touch.point) - pose[0]) / pose[1]

    start = side.middle_line.foot_point(point_in_axes(pose, other_pose), side.stretch)
    assert start
    sign = 1 if dot(touch.normal / pose[1], 1j * start.tangent) >= 0 else -1

    def contact_at(pose: Placed, other_pose: Placed) -> ContactGeometry:
        point = point_in_axes(pose, other_pose)
        foot = side.middle_line.foot_point_near(point, start.parameter)
        out = sign * 1j * foot.tangent
        gap = dot(point - foot.point, out) - side.half - touch.radius
        return ContactGeometry(out * pose[1], to_plane(pose, point - out * touch.radius), gap)

    return contact_at


def _side_on_curve(side: Side, out: complex, touch: Touch, other_pose: Placed) -> Trace:
    """Return the contact of a straight side with a curve.

    `out` is the unit normal of the straight side, along the axes of its body.
    """
    side_point = (touch.on_other - other_pose[0]) / other_pose[1]

    def contact_at(pose: Placed, other_pose: Placed) -> ContactGeometry:
        direction = out * other_pose[1] / pose[1]
        point = side.middle_line.lowest(direction, side.stretch)
        height = dot(point - (to_plane(other_pose, side_point) - pose[0]) / pose[1], direction)
        return ContactGeometry(
            -direction * pose[1], to_plane(pose, point - height * direction), height - side.half
        )

    return contact_at
