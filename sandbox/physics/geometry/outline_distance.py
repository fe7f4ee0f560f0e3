"""Outlines of shapes: the distance between them, and their possible contact points.

In pymunk a disc is a point with a radius, a wall two points with a radius, and a polygon its
corners with a very small radius. So the distance of two shapes is that of their cores, points of
the plane (here complex numbers) joined by straight edges, less both radii.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from math import inf
from operator import add, itemgetter
from typing import NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array

FLUSH = 1e-10
"""m, the largest difference in distance of the two ends of a side that both touch."""

FEELER = 1 << 31
"""The category of shapes that only meet arcs: the corners of shapes that may be inside one."""


@dataclass(frozen=True, slots=True)
class Outline:
    """A shape, in the axes of its body."""

    body: int
    """The body's index."""
    corners: tuple[complex, ...]
    """The corners of the core, counter-clockwise [m]."""
    radius: float
    """The radius around the core [m]."""
    extent: float
    """The largest distance of the core from the centre of the body [m]."""
    group: int = 0
    """The collision group; shapes of the same group do not touch, unless it is 0."""
    continuations: tuple[complex, complex] = (0j, 0j)
    """The vectors along the segments that continue a segment at its two ends; 0 without one."""


class Gap(NamedTuple):
    """The gap between two shapes."""

    distance: float
    """The distance, negative if they overlap [m]."""
    normal: complex
    """The unit vector from the first to the second."""
    points: tuple[complex, ...]
    """The one or two contact points, on the core of the first [m]."""


def outlines(bodies: Sequence[pymunk.Body]) -> list[Outline]:
    """Return the outlines of all shapes, in an order independent of memory addresses."""
    found = [
        outline_of(shape, row)
        for row, body in enumerate(bodies)
        for shape in without_feelers(body.shapes)
    ]
    return sorted(found, key=lambda o: (o.body, [(c.real, c.imag) for c in o.corners], o.radius))


def without_feelers(shapes: Iterable[pymunk.Shape]) -> list[pymunk.Shape]:
    """Return the shapes without feelers, which are for arcs only."""
    return [shape for shape in shapes if shape.filter.categories != FEELER]


def surfaces(bodies: Iterable[pymunk.Body]) -> Array:
    """Return the surface velocities of bodies, as of conveyor belts: (n, 2) [m/s]."""
    velocities = [[shape.surface_velocity for shape in body.shapes] for body in bodies]
    return np.array([shapes[0] if shapes else (0.0, 0.0) for shapes in velocities])


def outline_of(shape: pymunk.Shape, row: int) -> Outline:
    """Return the outline of a shape of the body with an index."""
    group, body = shape.filter.group, shape.body
    assert body
    match shape:
        case pymunk.Circle():
            center = complex(*shape.offset)
            return Outline(row, (center,), shape.radius, abs(center), group)
        case pymunk.Segment():
            others = [s for s in body.shapes if s is not shape and isinstance(s, pymunk.Segment)]
            lines = [(complex(*line.a), complex(*line.b)) for line in others]
            a, b = complex(*shape.a), complex(*shape.b)
            continuations = _continuation(a, lines), _continuation(b, lines)
            return Outline(row, (a, b), shape.radius, max(abs(a), abs(b)), group, continuations)
        case pymunk.Poly():
            corners = tuple(dict.fromkeys(complex(*corner) for corner in shape.get_vertices()))
            return Outline(row, corners, shape.radius, max(map(abs, corners)), group)
    raise TypeError(f"no outline of a {type(shape).__name__}")


def _continuation(end: complex, lines: Sequence[tuple[complex, complex]]) -> complex:
    """Return the vector along the segment that continues another at an end; 0 without one."""
    for a, b in lines:
        if end in (a, b):
            return (b if end == a else a) - end
    return 0j


class _Near(NamedTuple):
    """A corner of one core and the nearest point of an edge of another."""

    distance: float
    normal: complex  # from the first core to the second
    point: complex  # on the first core


class _Edge(NamedTuple):
    """An edge of a core."""

    start: complex
    end: complex
    along: complex  # from start to end
    square: float  # its length, squared
    out: complex  # the unit normal on its right


def gap(one: Sequence[complex], other: Sequence[complex], radii: float) -> Gap:
    """Return the gap between two cores, placed in the plane, thickened by two radii [m]."""
    if len(one) == len(other) == 1:
        distance, normal, point = _to_point(one[0], other[0])
        return Gap(distance - radii, normal, (point,))
    own, others = _edges(one), _edges(other)
    overlap = _overlap((one, own), (other, others))
    if overlap:
        return Gap(overlap.distance - radii, overlap.normal, (overlap.point,))
    near = _nearest(one, other, others, inf)
    least = min(near, key=itemgetter(0)).distance
    near += [_Near(d, -n, p + n * d) for d, n, p in _nearest(other, one, own, least)]
    best = min(near, key=itemgetter(0))
    side = best.normal * 1j
    touch = [best.point]
    for distance, normal, point in near:
        if distance <= best.distance + FLUSH and dot(normal, best.normal) > 1 - FLUSH:
            touch.append(point)
    ends = min(touch, key=lambda p: dot(p, side)), max(touch, key=lambda p: dot(p, side))
    points = ends if abs(ends[1] - ends[0]) > FLUSH else (best.point,)
    return Gap(best.distance - radii, best.normal, points)


def dot(a: complex, b: complex) -> float:
    """Return the scalar product of two vectors."""
    return a.real * b.real + a.imag * b.imag


def mean(points: Sequence[complex]) -> complex:
    """Return the mean of points, the same bits on every Python: some compensate for rounding."""
    return reduce(add, points) / len(points)


def _edges(core: Sequence[complex]) -> list[_Edge]:
    """Return the edges of a core; a segment has two, one in each direction, a point has none.

    Between corners that rounding puts at one place there is none.
    """
    found = []
    for i in range(len(core)):
        if along := core[i] - core[i - 1]:
            out = -1j * along / abs(along)
            found.append(_Edge(core[i - 1], core[i], along, dot(along, along), out))
    return found


def _nearest(
    one: Sequence[complex], other: Sequence[complex], edges: Sequence[_Edge], closest: float
) -> list[_Near]:
    """Return the nearest points of all edges of one core to every corner of another.

    Beside an edge the normal is that of the edge, which is accurate at any distance. Points further
    away than the `closest` known distance [m], or than one found here, are left out.
    """
    if not edges:
        return [_to_point(p, other[0]) for p in one]
    found = []
    for p in one:
        for a, b, along, square, out in edges:
            offset = p - a
            height = offset.real * out.real + offset.imag * out.imag
            if abs(height) > closest + FLUSH:
                continue
            projection = offset.real * along.real + offset.imag * along.imag
            if 0 < projection < square:
                near = _Near(abs(height), -out if height > 0 else out, p)
            else:
                near = _to_point(p, a if projection <= 0 else b)
            found.append(near)
            closest = min(closest, near.distance)
    return found


def _to_point(p: complex, q: complex) -> _Near:
    offset = q - p
    distance = abs(offset)
    return _Near(distance, offset / distance if distance else 1j, p)


Core = tuple[Sequence[complex], Sequence[_Edge]]
"""The corners and edges of a core."""


def _overlap(one: Core, other: Core) -> _Near | None:
    """Return the least overlap of two cores along the normal of an edge; None if they are apart.

    A point can only overlap with a polygon. Two segments overlap if they cross, but not if they
    only touch or are collinear, as their distances are then only rounding.
    """
    sizes = len(one[0]), len(other[0])
    thin = sizes[0] < 3 > sizes[1]
    if thin and 1 in sizes:
        return None
    tolerance = -FLUSH if thin else 0.0
    least: _Near | None = None
    for (_, edges), (against, _), sign in ((one, other, 1), (other, one, -1)):
        for a, _, _, _, out in edges:
            x, y = out.real, out.imag
            deepest = min(against, key=lambda p, x=x, y=y: p.real * x + p.imag * y)  # type: ignore[misc]
            distance = dot(deepest - a, out)
            if distance > tolerance:
                return None
            if least is None or distance > least.distance:
                least = _Near(distance, sign * out, deepest)
    return least


def width(shape: pymunk.Shape) -> float:
    """Return the smallest width of a shape [m]."""
    match shape:
        case pymunk.Circle():
            return 2 * shape.radius
        case pymunk.Segment():
            return 2 * shape.radius
        case pymunk.Poly():
            corners = np.array(shape.get_vertices())
            edges = np.roll(corners, -1, axis=0) - corners
            across = np.stack((-edges[:, 1], edges[:, 0]), axis=1) / np.hypot(*edges.T)[:, None]
            heights = across @ corners.T
            return float(np.ptp(heights, axis=1).min()) + 2 * shape.radius
    return inf


def smallest_width(space: pymunk.Space) -> float:
    """Return the smallest width of all shapes of dynamic bodies [m], 0 if there are none."""
    dynamic = [
        s
        for s in without_feelers(space.shapes)
        if s.body and s.body.body_type == pymunk.Body.DYNAMIC
    ]
    return min(map(width, dynamic), default=0.0)
