"""The shapes that a body can have.

A dynamic body's position is its centre of mass: the points of a polygon, segment, polyline or arc
are shifted so that their centre of mass is the origin of the body. Static and kinematic bodies keep
their points as written, relative to their position. Only they can have the shape `curve`.
"""

from math import tau
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from sandbox.model import functions_of_one_variable
from sandbox.model.base import Model
from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.number_bounds import Acceleration, Coordinate, Extent, Speed, Width
from sandbox.model.translatable_message import Message

Point = tuple[Coordinate, Coordinate]
"""Two coordinates: [x, y] in m."""

Velocity = tuple[Speed, Speed]
"""[x, y] in m/s."""

Fall = tuple[Acceleration, Acceleration]
"""[x, y] in m/s²."""

XY = tuple[float, float]


def evaluate(point: tuple[Expression, Expression], values: Values) -> XY:
    """Return the components of a point or a vector for given parameters."""
    return point[0](values), point[1](values)


THINNEST = 1e-7
"""The least width of a polygon that collides [m]."""

SLIMMEST = 1e-5
"""The same, as a share of its length."""


class Disc(Model):
    """A uniform disc: I = m r² / 2."""

    type: Literal["disc"]
    radius: Extent
    """m"""


class Hoop(Model):
    """A thin ring, hollow: bodies touch it from outside or, within it, from inside; I = m r²."""

    type: Literal["hoop"]
    radius: Extent
    """m"""


class Box(Model):
    """A uniform rectangle: I = m (w² + h²) / 12."""

    type: Literal["box"]
    width: Extent
    """m"""
    height: Extent
    """m"""


class Polygon(Model):
    """A uniform simple polygon, convex or not."""

    type: Literal["polygon"]
    vertices: Annotated[tuple[Point, ...], Field(min_length=3, max_length=200)]
    """[x, y] in m, in the body's frame"""


class Segment(Model):
    """A straight line between two points: a thin rod, I = m L² / 12."""

    type: Literal["segment"]
    start: Point
    """[x, y] in m, in the body's frame"""
    end: Point
    """[x, y] in m, in the body's frame"""
    thickness: Width = Width(0)
    """m"""


class Polyline(Model):
    """An open chain of segments, such as a ramp or a curved floor."""

    type: Literal["polyline"]
    points: Annotated[tuple[Point, ...], Field(min_length=2, max_length=2000)]
    """[x, y] in m, in the body's frame"""
    thickness: Width = Width(0)
    """m"""


class Arc(Model):
    """An arc of a circle, touched from inside and outside: a loop, a half-pipe, a hollow.

    It is a thin wire, I = m (r² − c²), where c is the distance of its centre of mass from the
    centre of the circle. The body's position is the centre of the circle or, if the body is
    dynamic, the centre of mass.
    """

    type: Literal["arc"]
    radius: Extent
    """m, to the middle of its thickness"""
    start: Expression
    """rad, the direction of its start from the centre; `"180*deg"` for degrees"""
    end: Expression
    """rad, the direction of its end; larger than `start`, since the arc runs counter-clockwise"""
    thickness: Width = Width(0)
    """m"""


class Curve(Model):
    """A smooth curve, touched from both sides: a bowl, a slide, a row of hills.

    Its body is static or kinematic. Bodies touch the curve itself, not a polyline along it. A curve
    whose ends meet is closed.
    """

    type: Literal["curve"]
    curve: tuple[functions_of_one_variable.Curve, functions_of_one_variable.Curve]
    """[x, y] in m of its points in the body's frame, functions of the parameters and s"""
    s: tuple[Expression, Expression]
    """[from, to], the range of s"""
    thickness: Width = Width(0)
    """m"""


Area = Disc | Box | Polygon
"""Shapes that cover a part of the plane."""

Line = Segment | Polyline | Arc | Curve
"""Shapes with a start and an end, and so a left and a right side."""

Shape = Annotated[
    Disc | Hoop | Box | Polygon | Segment | Polyline | Arc | Curve, Field(discriminator="type")
]

ROUND_OFF = 1e-12
"""The excess of an arc over a full circle that is allowed [rad]."""


def points_of(shape: Polygon | Segment | Polyline) -> tuple[Point, ...]:
    """Return the points that define a shape."""
    match shape:
        case Polygon():
            return shape.vertices
        case Segment():
            return (shape.start, shape.end)
        case Polyline():
            return shape.points


def fault(shape: Shape, values: Values) -> Message | None:
    """Say what is wrong with a shape's geometry for given parameters; None if nothing is."""
    if isinstance(shape, Arc):
        return _arc_fault(shape, values)
    if not isinstance(shape, Polygon | Segment | Polyline):
        return None
    points = np.array([evaluate(point, values) for point in points_of(shape)])
    closed = isinstance(shape, Polygon)
    ends = np.roll(points, -1, axis=0) if closed else points[1:]
    starts = points if closed else points[:-1]
    same = np.flatnonzero(np.all(starts == ends, axis=1))
    if same.size:
        i = int(same[0])
        return Message("the points {i} and {j} are the same", i=i, j=(i + 1) % len(points))
    with np.errstate(all="ignore"):
        return _polygon_fault(starts, ends) if closed else None


def _arc_fault(arc: Arc, values: Values) -> Message | None:
    start, end = arc.start(values), arc.end(values)
    if not start < end:
        return Message(
            "'end' must be larger than 'start', {start:.6g} rad, but it is {end:.6g} rad",
            start=start,
            end=end,
        )
    if end - start > tau + ROUND_OFF:
        return Message(
            "an arc spans at most a full circle, but this one spans {turn:.6g} rad",
            turn=end - start,
        )
    radius, thickness = arc.radius(values), arc.thickness(values)
    if thickness >= 2 * radius:
        return Message(
            "a 'thickness' of {thickness:.3g} m fills the whole inside of an arc of radius"
            " {radius:.3g} m",
            thickness=thickness,
            radius=radius,
        )
    return None


def _polygon_fault(starts: Array, ends: Array) -> Message | None:
    crossing = _crossings(starts, ends)
    if crossing.size:
        i, j = crossing[0]
        return Message(
            "the polygon crosses itself: the edge from point {i} meets that from point {j}",
            i=i,
            j=j,
        )
    area = np.sum(_turn(starts[0], starts, ends)) / 2
    extent = np.max(np.ptp(starts, axis=0))
    if abs(area) <= 1e-12 * extent**2:
        return Message("the polygon has no area")
    width = 2 * abs(area) / extent
    if width < max(THINNEST, SLIMMEST * extent):
        return Message(
            "the polygon is too thin: {width:.1g} m over a length of {extent:.3g} m",
            width=width,
            extent=extent,
        )
    return None


def _crossings(starts: Array, ends: Array) -> NDArray[np.int64]:
    """Return the pairs of non-adjacent edges that have a point in common."""
    count = len(starts)
    i, j = np.triu_indices(count, k=2)
    apart = (j - i) != count - 1
    i, j = i[apart], j[apart]
    a, b, c, d = starts[i], ends[i], starts[j], ends[j]
    turns = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    meet = (turns[0] * turns[1] < 0) & (turns[2] * turns[3] < 0)
    for turn, p, q, r in zip(turns, (a, a, c, c), (b, b, d, d), (c, d, a, b), strict=True):
        meet |= (turn == 0) & _between(p, q, r)
    return np.stack([i, j], axis=1)[meet]


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Return twice the area of the triangle a-b-c, positive if it is counter-clockwise."""
    ab, ac = b - a, c - a
    return np.asarray(ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0])


def _between(a: Array, b: Array, c: Array) -> NDArray[np.bool_]:
    """Return whether c, which must be collinear with a and b, lies between them."""
    inside = (np.minimum(a, b) <= c) & (c <= np.maximum(a, b))
    return np.asarray(np.all(inside, axis=-1))
