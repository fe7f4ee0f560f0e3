"""Corners that stand on something at the start, and fall short of it.

The inset of polygons rounds their corners off: one that stands on a floor by its corner, as a
ladder does, would be out of touch by some 1e-9 m, and fall freely in the first step.
"""

import pymunk

from sandbox.physics.contacts.shapes import DIRECT_HAIR


def reach_out(space: pymunk.Space) -> None:
    """Let polygons that fall short of what they stand on stand as proud as corners need."""
    short = {
        shape
        for body in space.bodies
        if body.body_type == pymunk.Body.DYNAMIC
        for shape in body.shapes
        if isinstance(shape, pymunk.Poly) and _falls_short(space, shape)
    }
    for shape in short:
        shape.unsafe_set_radius(shape.radius + DIRECT_HAIR)


def _falls_short(space: pymunk.Space, shape: pymunk.Poly) -> bool:
    """Whether a polygon touches something only if it stands prouder."""
    own = shape.radius
    shape.unsafe_set_radius(own + DIRECT_HAIR)
    hits = [hit.contact_point_set.points for hit in space.shape_query(shape)]
    shape.unsafe_set_radius(own)
    return any(0 < -min(p.distance for p in points) <= DIRECT_HAIR for points in hits if points)
