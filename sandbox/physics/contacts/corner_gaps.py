"""Closes gaps at corners that should touch at the start, due to the rounding of polygons.

The inset of polygons rounds their corners off: a polygon that stands on a floor by its corner, as a
ladder does, would have a gap of some 1e-9 m, and fall freely in the first step. The gap is larger
at sharper corners.
"""

from collections.abc import Iterator

import pymunk

from sandbox.physics.contacts.shapes import SKIN

REACH = 1e-7
"""m, the largest gap at a corner that is closed; a corner of 20° has at most 9.5e-8."""


def reach_out(space: pymunk.Space) -> None:
    """Enlarge the radius of polygons by their gaps."""
    short: dict[pymunk.Poly, float] = {}
    for body in space.bodies:
        for shape in body.shapes if body.body_type == pymunk.Body.DYNAMIC else ():
            for polygon, gap in _gaps(space, shape):
                short[polygon] = max(gap, short.get(polygon, 0.0))
    for polygon, gap in short.items():
        polygon.unsafe_set_radius(polygon.radius + gap + SKIN)


def _gaps(space: pymunk.Space, shape: pymunk.Shape) -> Iterator[tuple[pymunk.Poly, float]]:
    """Yield the polygons to enlarge for a shape, with their gaps [m]."""
    if not isinstance(shape, pymunk.Poly | pymunk.Circle):
        return
    own = shape.radius
    shape.unsafe_set_radius(own + REACH)
    hits = [(hit.shape, hit.contact_point_set.points) for hit in space.shape_query(shape)]
    shape.unsafe_set_radius(own)
    for other, points in hits:
        gap = REACH + min((point.distance for point in points), default=0.0)
        polygon = shape if isinstance(shape, pymunk.Poly) else other
        if 0 <= gap < REACH and isinstance(polygon, pymunk.Poly):
            yield polygon, gap
