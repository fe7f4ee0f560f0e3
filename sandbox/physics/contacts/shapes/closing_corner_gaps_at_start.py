"""Closes gaps at corners that should touch at the start, due to the rounding of polygons.

The inset of polygons rounds their corners off: a polygon that stands on a floor by its corner, as a
ladder does, would have a gap of some 1e-9 m, and fall freely in the first step. The gap is larger
at sharper corners.
"""

from collections.abc import Iterator
from math import inf, sqrt

import numpy as np
import pymunk

from sandbox.physics.contacts.shapes.pymunk_shapes import SKIN

REACH = 1e-7
"""m, the largest gap at a corner that is closed; a corner of 20° has at most 9.5e-8."""

SHARPEST = 1e-6
"""m, the same where a polygon has sharper corners, which may fall shorter: down to 2°."""


def reach_out(space: pymunk.Space) -> None:
    """Enlarge the radius of polygons by their gaps."""
    polygons = [shape for shape in space.shapes if isinstance(shape, pymunk.Poly)]
    reach = min(SHARPEST, max(map(_falls_short, polygons), default=0.0))
    short: dict[pymunk.Poly, float] = {}
    for body in space.bodies:
        for shape in body.shapes if body.body_type == pymunk.Body.DYNAMIC else ():
            for polygon, gap in _gaps(space, shape, max(REACH, reach)):
                short[polygon] = max(gap, short.get(polygon, 0.0))
    for polygon, gap in short.items():
        polygon.unsafe_set_radius(polygon.radius + gap + SKIN)


def _falls_short(polygon: pymunk.Poly) -> float:
    """Return how far the sharpest corner of a polygon is rounded off [m]."""
    corners = np.array([complex(*corner) for corner in polygon.get_vertices()])
    sides = np.roll(corners, -1) - corners
    sides /= np.abs(sides)
    blunt = 1 + (np.roll(sides, 1).conj() * sides).real.min()
    return polygon.radius * (sqrt(2 / blunt) - 1) if blunt > 0 else inf


def _gaps(
    space: pymunk.Space, shape: pymunk.Shape, reach: float
) -> Iterator[tuple[pymunk.Poly, float]]:
    """Yield the polygons to enlarge for a shape, with their gaps up to a reach [m]."""
    if not isinstance(shape, pymunk.Poly | pymunk.Circle):
        return
    own = shape.radius
    shape.unsafe_set_radius(own + reach)
    hits = [(hit.shape, hit.contact_point_set) for hit in space.shape_query(shape)]
    shape.unsafe_set_radius(own)
    for other, found in hits:
        # pymunk's own distance has the wrong sign if it takes the other shape first
        depths = [(p.point_a - p.point_b).dot(found.normal) for p in found.points]
        gap = reach - max(depths, default=0.0)
        polygon = shape if isinstance(shape, pymunk.Poly) else other
        if 0 <= gap < reach and isinstance(polygon, pymunk.Poly):
            yield polygon, gap
