"""Feelers: small discs that detect contacts between corners and hollow shapes."""

from collections.abc import Sequence
from typing import NamedTuple

import pymunk

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.shapes import Curve, Polyline, Segment
from sandbox.physics.geometry.outline_distance import FEELER

HOLLOW = 1 << 30
"""The category of arcs and curves, which collide with feelers."""

ORDINARY = pymunk.ShapeFilter(categories=0xFFFFFFFF & ~(HOLLOW | FEELER))

FELT = 0.5
"""The greatest overlap with an arc from inside at which a feeler still detects the contact, as a
share of the shape's length, or of the radius of an arc."""


class ShapedBody(NamedTuple):
    """A body with contact shapes.

    `row` is its index, `spec` its description in the level, and `body` the body in pymunk; `points`
    are the corners of its shape, relative to it [m].
    """

    row: int
    spec: Body
    body: pymunk.Body
    shapes: Sequence[pymunk.Shape]
    points: Sequence[complex]

    @property
    def moves(self) -> bool:
        """Whether it is dynamic."""
        return self.spec.type == "dynamic"


def half_of(body: ShapedBody, values: Values, skin: float) -> float:
    """Return half the thickness of a line, with the skin [m]."""
    shape = body.spec.shape
    assert isinstance(shape, Segment | Polyline | Curve)
    return shape.thickness(values) / 2 + skin


def make_feeler(shape: pymunk.Shape, corner: complex, reach: float) -> pymunk.Circle:
    """Return the feeler of a corner of a shape, with a reach [m]."""
    feeler = disc_like(shape, corner, reach)
    feeler.filter = pymunk.ShapeFilter(categories=FEELER, mask=HOLLOW)
    return feeler


def disc_like(shape: pymunk.Shape, center: complex, radius: float) -> pymunk.Circle:
    """Return a disc with the friction and restitution of another shape of the same body."""
    disc = pymunk.Circle(shape.body, radius, (center.real, center.imag))
    disc.friction, disc.elasticity = shape.friction, shape.elasticity
    disc.collision_type, disc.filter = shape.collision_type, ORDINARY
    return disc


def core_of(shape: pymunk.Shape) -> list[complex]:
    """Return the points whose convex hull, thickened by the radius, is the shape [m].

    They are along the axes of its body.
    """
    match shape:
        case pymunk.Circle():
            return [complex(*shape.offset)]
        case pymunk.Segment():
            return [complex(*shape.a), complex(*shape.b)]
        case pymunk.Poly():
            return [complex(*corner) for corner in shape.get_vertices()]
    raise TypeError(f"no core of a {type(shape).__name__}")
