"""pymunk's bodies: where they start, their mass and moment, and the corners of their shapes."""

from itertools import pairwise
from math import inf

import numpy as np
import pymunk

from sandbox.model.expressions import Values
from sandbox.model.level import Body, Level
from sandbox.model.shapes import (
    XY,
    Box,
    Disc,
    Hoop,
    Polygon,
    Polyline,
    Segment,
    evaluate,
    points_of,
)


def make_body(spec: Body, level: Level, values: Values) -> pymunk.Body:
    """Make a body where it starts, without a shape; unless things rotate its moment is infinite."""
    if spec.type == "dynamic":
        assert spec.mass is not None
        mass = spec.mass(values)
        body = pymunk.Body(mass, _moment(spec, mass, values) if level.effects.rotation else inf)
    else:
        static = spec.type == "static"
        body = pymunk.Body(body_type=pymunk.Body.STATIC if static else pymunk.Body.KINEMATIC)
    body.position = evaluate(spec.position, values)
    body.angle = spec.angle(values)
    if spec.type != "static":
        body.velocity = evaluate(spec.velocity, values)
        body.angular_velocity = spec.angular_velocity(values)
    return body


def _moment(spec: Body, mass: float, values: Values) -> float:
    """Return the moment of inertia about the centre of mass [kg m²]."""
    if spec.moment is not None:
        return spec.moment(values)
    match spec.shape:
        case Disc(radius=radius):
            return pymunk.moment_for_circle(mass, 0, radius(values))
        case Hoop(radius=radius):
            return pymunk.moment_for_circle(mass, radius(values), radius(values))
        case Box(width=width, height=height):
            return pymunk.moment_for_box(mass, (width(values), height(values)))
        case Polygon():
            return pymunk.moment_for_poly(mass, local_points(spec, values))
        case Segment() | Polyline():
            return _moment_of_line(mass, local_points(spec, values))


def _moment_of_line(mass: float, points: list[XY]) -> float:
    """Return the moment of a thin wire through points about the origin: Σ m_i (a² + a·b + b²)/3."""
    edges = np.array([(a, b) for a, b in pairwise(points)])
    a, b = edges[:, 0], edges[:, 1]
    length = np.hypot(*(b - a).T)
    square = np.sum(a * a + a * b + b * b, axis=1) / 3
    return float(mass * np.sum(length * square) / np.sum(length))


def local_points(spec: Body, values: Values) -> list[XY]:
    """Return the corners of a body's shape relative to it [m]; those of a disc or hoop are none.

    A dynamic body's are moved so that the origin is its centre of mass.
    """
    shape = spec.shape
    if isinstance(shape, Disc | Hoop):
        return []
    if isinstance(shape, Box):
        x, y = shape.width(values) / 2, shape.height(values) / 2
        return [(-x, -y), (x, -y), (x, y), (-x, y)]
    points = [evaluate(point, values) for point in points_of(shape)]
    if spec.type != "dynamic":
        return points
    cx, cy = _centroid(points, closed=isinstance(shape, Polygon))
    return [(x - cx, y - cy) for x, y in points]


def _centroid(points: list[XY], *, closed: bool) -> XY:
    """Return the centre of mass of a uniform polygon, or of a uniform wire."""
    a = np.array(points)
    b = np.roll(a, -1, axis=0)
    if closed:
        cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        x, y = ((a + b) * cross[:, None]).sum(axis=0) / (3 * cross.sum())
    else:
        a, b = a[:-1], b[:-1]
        x, y = np.average((a + b) / 2, axis=0, weights=np.hypot(*(b - a).T))
    return float(x), float(y)
