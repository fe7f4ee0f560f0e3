"""Makes pymunk's bodies: initial state, mass, moment of inertia, and corners of shapes."""

from cmath import rect
from itertools import pairwise
from math import ceil, inf, pi, sin

import numpy as np
import pymunk

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.shapes import (
    XY,
    Arc,
    Box,
    Curve,
    Disc,
    Hoop,
    Polygon,
    Polyline,
    Segment,
    evaluate,
    points_of,
)
from sandbox.model.translatable_message import Message
from sandbox.model.wire_points import along
from sandbox.physics.state.simulation_errors import SimulationError

FAR = 1000
"""The largest distance of a polygon's corners from the origin, over its size. Beyond it the area is
lost in the rounding of squares, and corners are taken relative to the first."""

FACETS = 96
"""The number of straight segments of a circle."""

DRAWN = 512
"""The number of straight segments of a curve."""


def make_body(name: str, level: Level, values: Values) -> pymunk.Body:
    """Make a body in its initial state, without a shape; without rotation its moment is infinite.

    Raises `SimulationError` if its moment of inertia is not positive.
    """
    spec = level.bodies[name]
    if spec.type == "dynamic":
        assert spec.mass is not None
        mass = spec.mass(values)
        moment = _moment(spec, mass, values) if level.effects.rotation else inf
        if not moment > 0:  # with which pymunk aborts the process
            rule = Message(
                "its moment of inertia is {moment:g} kg m², so its corners do not form a shape",
                moment=moment,
            )
            raise SimulationError(name, 0.0, rule)
        body = pymunk.Body(mass, moment)
    else:
        static = spec.type == "static"
        body = pymunk.Body(body_type=pymunk.Body.STATIC if static else pymunk.Body.KINEMATIC)
    body.position = evaluate(spec.position, values)
    body.angle = spec.angle(values)
    if spec.type != "static":
        body.velocity = evaluate(spec.velocity, values)
        body.angular_velocity = spec.angular_velocity(values)
    if spec.motion:
        from sandbox.physics.engine.prescribed_motion import velocities_at_start

        body.velocity, body.angular_velocity = velocities_at_start(spec.motion, values)
    return body


def _moment(spec: Body, mass: float, values: Values) -> float:
    """Return the moment of inertia about the centre of mass [kg m²]."""
    if spec.moment is not None:
        return spec.moment(values)
    assert not isinstance(spec.shape, Curve)
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
        case Arc() as arc:
            return mass * (arc.radius(values) ** 2 - abs(_middle_of(arc, values)) ** 2)


def _moment_of_line(mass: float, points: list[XY]) -> float:
    """Return the moment of a thin wire about the origin [kg m²]: Σ m_i (a² + a·b + b²)/3."""
    edges = np.array([(a, b) for a, b in pairwise(points)])
    a, b = edges[:, 0], edges[:, 1]
    length = np.hypot(*(b - a).T)
    square = np.sum(a * a + a * b + b * b, axis=1) / 3
    return float(mass * np.sum(length * square) / np.sum(length))


def _middle_of(arc: Arc, values: Values) -> complex:
    """Return the centre of mass of a thin arc, relative to the centre of its circle [m]."""
    start, end = arc.start(values), arc.end(values)
    half = (end - start) / 2
    return rect(arc.radius(values) * sin(half) / half, (start + end) / 2)


def center_of(arc: Arc, spec: Body, values: Values) -> complex:
    """Return the centre of an arc's circle, relative to its body [m]."""
    return -_middle_of(arc, values) if spec.type == "dynamic" else 0j


def _points_along(arc: Arc, spec: Body, values: Values) -> list[XY]:
    start, end = arc.start(values), arc.end(values)
    center, radius = center_of(arc, spec, values), arc.radius(values)
    count = max(ceil(FACETS * (end - start) / (2 * pi)), 2)
    points = [center + rect(radius, start + (end - start) * i / count) for i in range(count + 1)]
    return [(point.real, point.imag) for point in points]


def local_points(spec: Body, values: Values) -> list[XY]:
    """Return the corners of a shape in the axes of its body [m]; none for a disc or hoop.

    If the body is dynamic, the origin is its centre of mass. For an arc or curve, they are points
    on it, for drawing.
    """
    shape = spec.shape
    if isinstance(shape, Curve):
        return [(point.real, point.imag) for point in along(shape, values, DRAWN).tolist()]
    if isinstance(shape, Arc):
        return _points_along(shape, spec, values)
    if isinstance(shape, Disc | Hoop):
        return []
    if isinstance(shape, Box):
        x, y = shape.width(values) / 2, shape.height(values) / 2
        return [(-x, -y), (x, -y), (x, y), (-x, y)]
    points = [evaluate(point, values) for point in points_of(shape)]
    if spec.type != "dynamic":
        return points
    points = _from_near(points)
    cx, cy = _centroid(points, closed=isinstance(shape, Polygon))
    return [(x - cx, y - cy) for x, y in points]


def _from_near(points: list[XY]) -> list[XY]:
    """Return points relative to the first if they are far from the origin, else unchanged."""
    corners = np.array(points)
    if np.abs(corners).max() <= FAR * np.ptp(corners, axis=0).max():
        return points
    return [(float(x), float(y)) for x, y in corners - corners[0]]


def _centroid(points: list[XY], *, closed: bool) -> XY:
    """Return the centre of mass of a uniform polygon if closed, else of a uniform wire [m]."""
    a = np.array(points)
    b = np.roll(a, -1, axis=0)
    if closed:
        cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        x, y = ((a + b) * cross[:, None]).sum(axis=0) / (3 * cross.sum())
    else:
        a, b = a[:-1], b[:-1]
        x, y = np.average((a + b) / 2, axis=0, weights=np.hypot(*(b - a).T))
    return float(x), float(y)
