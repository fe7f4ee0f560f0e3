"""Closes gaps at corners that should touch at the start, due to the rounding of polygons.

The inset of polygons rounds their corners off: a polygon that stands on a floor by its corner, as a
ladder does, would have a gap of some 1e-9 m, and fall freely in the first step. The gap is larger
at sharper corners.
"""

from collections.abc import Iterator, Sequence
from math import inf, sqrt

import numpy as np
import pymunk

from sandbox.physics.contacts.shapes.pymunk_shapes import SKIN
from sandbox.physics.engine.shape_pairs import close_pairs, is_dynamic, overlap
from sandbox.physics.state.cancellation_points import cancellation_point

REACH = 1e-7
"""m, the largest gap at a corner that is closed; a corner of 20° has at most 9.5e-8."""

SHARPEST = 1e-6
"""m, the same where a polygon has sharper corners, which may fall shorter: down to 2°."""


def reach_out(space: pymunk.Space) -> None:
    """Enlarge the radius of polygons by their gaps."""
    polygons = [shape for shape in space.shapes if isinstance(shape, pymunk.Poly)]
    if not polygons:
        return
    reach = max(REACH, min(SHARPEST, max(map(_falls_short, polygons))))
    short: dict[pymunk.Poly, float] = {}
    for shape, others in _partners(space, reach).items():
        cancellation_point()
        for polygon, gap in _gaps(shape, others, reach):
            short[polygon] = max(gap, short.get(polygon, 0.0))
    for polygon, gap in short.items():
        polygon.unsafe_set_radius(polygon.radius + gap + SKIN)


def _partners(space: pymunk.Space, reach: float) -> dict[pymunk.Shape, list[pymunk.Shape]]:
    """Return the shapes that are close to each movable disc or polygon; one is a polygon."""
    shapes = list(space.shapes)
    polygons = {shape for shape in shapes if isinstance(shape, pymunk.Poly)}
    movable = {s for s in shapes if is_dynamic(s) and not isinstance(s, pymunk.Segment)}
    found: dict[pymunk.Shape, list[pymunk.Shape]] = {}
    for one, other in close_pairs(shapes, 2 * reach, own=True):
        if one in polygons or other in polygons:
            if one in movable:
                found.setdefault(one, []).append(other)
            if other in movable:
                found.setdefault(other, []).append(one)
    return found


def _falls_short(polygon: pymunk.Poly) -> float:
    """Return how far the sharpest corner of a polygon is rounded off [m]."""
    corners = np.array([complex(*corner) for corner in polygon.get_vertices()])
    sides = np.roll(corners, -1) - corners
    sides /= np.abs(sides)
    blunt = 1 + (np.roll(sides, 1).conj() * sides).real.min()
    return polygon.radius * (sqrt(2 / blunt) - 1) if blunt > 0 else inf


def _gaps(
    shape: pymunk.Shape, others: Sequence[pymunk.Shape], reach: float
) -> Iterator[tuple[pymunk.Poly, float]]:
    """Yield the polygons to enlarge for a disc or polygon, with their gaps up to a reach [m]."""
    assert isinstance(shape, pymunk.Poly | pymunk.Circle)
    own = shape.radius
    shape.unsafe_set_radius(own + reach)
    shape.cache_bb()
    hits = [(other, overlap(shape, other)) for other in others]
    shape.unsafe_set_radius(own)
    for other, found in hits:
        polygon = shape if isinstance(shape, pymunk.Poly) else other
        gap = reach - found[1] if found else reach
        if 0 <= gap < reach and isinstance(polygon, pymunk.Poly):
            yield polygon, gap
