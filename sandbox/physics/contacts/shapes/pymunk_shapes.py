"""The shapes of bodies in pymunk, and pymunk's settings for their contacts."""

from itertools import pairwise

import numpy as np
import pymunk
from pymunk import Vec2d

from sandbox.model.body import Body
from sandbox.model.effects.contact import Contact
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
    Shape,
    evaluate,
)
from sandbox.physics.engine.pymunk_bodies import center_of, local_points
from sandbox.physics.geometry.convex_decomposition import convex_parts, twice_area
from sandbox.physics.geometry.curve_contacts import middle_line_of
from sandbox.physics.geometry.outline_distance import smallest_width
from sandbox.physics.geometry.plane_curve import Stretch

SKIN = 1e-9
"""m, the thickness of the skin on flat surfaces. To pymunk, bodies with zero distance do not touch:
a block placed on a surface would fall freely for half a step. Discs keep their radius, for
rolling."""

DIRECT_SKIN = 1e-8
"""m, the same for the direct solver. It is thick enough for corners to touch although the inset of
polygons rounds them off by 4e-9 m."""

INSET = 1e-8
"""m, the inset of the core of a polygon, which has this as its radius. Each body's differs a
little: between boxes of equal width that are aligned up to rounding, pymunk occasionally finds a
sideways normal and throws them apart."""

SHARPEST = 1e-8
"""One plus the cosine between the normals of a corner's sides below which there is no inset."""

GOLDEN = 0.6180339887498949
"""The golden ratio less 1; the fractional parts of its multiples are well spaced."""

CORRECTION = 0.2
"""The share of an overlap that is corrected in a step, unless the level gives another."""

SLOP = 1e-6
"""m, the overlap that is not corrected, unless the level gives another."""

PILE_SLOP = 0.005
"""The same in piles, as a share of the width of the narrowest movable body. With a tenth of it, the
correction of overlaps keeps stirring stacks of 8 and more boxes, and they never rest."""


def skip_ids(space: pymunk.Space, level: Level) -> None:
    """Use up the ids of shapes that are as small as the indices of corners.

    pymunk recognises a contact by a hash of the two shapes' ids and corners. If both numbers come
    from the same small range, the two ends of a box's side can have the same hash, and the warm
    start of one end is the impulse of the other: a box with friction then never comes to rest.
    """
    corners = [len(b.shape.vertices) for b in level.bodies.values() if isinstance(b.shape, Polygon)]
    spare = pymunk.Circle(space.static_body, 1.0)
    for _ in range(max([4, *corners]) + 1):
        space.add(spare)
        space.remove(spare)


def make_surfaces(
    spec: Body, body: pymunk.Body, level: Level, values: Values, skin: float, kind: int
) -> list[pymunk.Shape]:
    """Make the contact shapes of a body; a sensor has none."""
    if spec.sensor:
        return []
    shapes = _outline(spec, spec.shape, body, values, skin, kind)
    effects = level.effects
    for shape in shapes:
        shape.collision_type = kind
        if effects.friction and spec.friction is not None:
            shape.friction = spec.friction(values)
        if effects.restitution and spec.restitution is not None:
            shape.elasticity = spec.restitution(values)
    return shapes


def run_belts(level: Level, values: Values, bodies: dict[str, pymunk.Body]) -> None:
    """Set the surface velocities of belts; pymunk uses only the component along a contact."""
    for belt in level.effects.belt or ():
        body = bodies[belt.body]
        along = Vec2d(*evaluate(belt.velocity, values)).rotated(body.angle)
        for shape in body.shapes:
            shape.surface_velocity = along


def _outline(
    spec: Body, shape: Shape, body: pymunk.Body, values: Values, skin: float, kind: int
) -> list[pymunk.Shape]:
    points = local_points(spec, values)
    match shape:
        case Disc(radius=radius) | Hoop(radius=radius):
            return [pymunk.Circle(body, radius(values))]
        case Box():
            return [_convex(body, points, skin, kind)]
        case Polygon():
            return [_convex(body, part, skin, kind) for part in convex_parts(points)]
        case Segment(thickness=thickness) | Polyline(thickness=thickness):
            return _line(body, points, thickness(values) / 2 + skin)
        case Arc(radius=radius, thickness=thickness):
            center = center_of(shape, spec, values)
            outer = radius(values) + thickness(values) / 2 + skin
            return [pymunk.Circle(body, outer, (center.real, center.imag))]
        case Curve(thickness=thickness):
            half = thickness(values) / 2 + skin
            return [_around(body, part, half) for part in middle_line_of(shape, values).stretches]


def _around(body: pymunk.Body, part: Stretch, half: float) -> pymunk.Shape:
    """Make a disc that encloses a stretch of a curve."""
    return pymunk.Circle(body, part.radius + half, (part.center.real, part.center.imag))


def _convex(body: pymunk.Body, points: list[XY], skin: float, kind: int) -> pymunk.Shape:
    """Make a convex polygon with a skin, as a smaller polygon with a radius.

    A part of a decomposed polygon may be too sharp for that; it has the skin alone.
    """
    if not skin:
        return pymunk.Poly(body, points)
    inset = INSET * (1 + kind * GOLDEN % 1)
    a = np.array(points)
    edge = np.concatenate((a[1:], a[:1])) - a
    outwards = np.stack([edge[:, 1], -edge[:, 0]], axis=1) / np.hypot(*edge.T)[:, None]
    outwards *= np.sign(twice_area(a))
    before = np.concatenate((outwards[-1:], outwards[:-1]))
    blunt = 1 + np.sum(before * outwards, axis=1)
    if blunt.min() < SHARPEST:
        return pymunk.Poly(body, points, radius=skin)
    core = a - inset * (before + outwards) / blunt[:, None]
    return pymunk.Poly(body, [(float(x), float(y)) for x, y in core], radius=inset + skin)


def _line(body: pymunk.Body, points: list[XY], radius: float) -> list[pymunk.Shape]:
    """Make the segments through the points, linked as neighbours so that no ball trips."""
    lines: list[pymunk.Shape] = []
    for i, (a, b) in enumerate(pairwise(points)):
        line = pymunk.Segment(body, a, b, radius)
        line.set_neighbors(points[max(i - 1, 0)], points[min(i + 2, len(points) - 1)])
        lines.append(line)
    return lines


def leave_contacts(space: pymunk.Space) -> None:
    """Let pymunk find contacts, and solve as little as possible."""
    space.collision_bias, space.iterations = 1.0, 1


def choose_correction(space: pymunk.Space, level: Level, values: Values, dt: float) -> None:
    """Choose the correction of overlaps; pymunk's defaults are meant for pixels."""
    contact = level.effects.contact
    assert contact is not None
    if contact.correction is not None:
        correction = contact.correction(values)
    else:
        correction = 0.0 if level.effects.restitution else CORRECTION
    space.collision_bias = (1 - correction) ** (1 / dt)
    space.collision_slop = slop_of(space, contact, values)


def slop_of(space: pymunk.Space, contact: Contact, values: Values) -> float:
    """Return the overlap of bodies that is not corrected [m]."""
    if contact.slop is not None:
        return contact.slop(values)
    return PILE_SLOP * smallest_width(space) if contact.piles else SLOP
