"""Feelers: small discs that find where the corners of bodies touch hollow shapes."""

from collections.abc import Sequence
from typing import NamedTuple

import pymunk

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.shapes import Curve, Polyline, Segment
from sandbox.physics.geometry.distance import FEELER

HOLLOW = 1 << 30
"""The category of the sides of arcs, and of curves, which feelers meet."""

ORDINARY = pymunk.ShapeFilter(categories=0xFFFFFFFF & ~(HOLLOW | FEELER))

FELT = 0.5
"""The share of its length by which what touches an arc from inside may be too deep in it, and a
corner still find it; of an arc the share of its radius."""


class Made(NamedTuple):
    """A body that may be touched.

    Attributes
    ----------
    row
        Its index.
    spec
        What the level says of it.
    body
        pymunk's.
    shapes
        With which it touches others.
    points
        The corners of its shape, relative to it [m].
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


def half_of(body: Made, values: Values, skin: float) -> float:
    """Return how far the sides of a line are from its middle [m]."""
    shape = body.spec.shape
    assert isinstance(shape, Segment | Polyline | Curve)
    return shape.thickness(values) / 2 + skin


def make_feeler(shape: pymunk.Shape, corner: complex, reach: float) -> pymunk.Circle:
    """Return the feeler of a corner of a shape, with a reach [m]."""
    feeler = disc_like(shape, corner, reach)
    feeler.filter = pymunk.ShapeFilter(categories=FEELER, mask=HOLLOW)
    return feeler


def disc_like(shape: pymunk.Shape, center: complex, radius: float) -> pymunk.Circle:
    """Return a disc that rubs and bounces as another shape of the same body."""
    disc = pymunk.Circle(shape.body, radius, (center.real, center.imag))
    disc.friction, disc.elasticity = shape.friction, shape.elasticity
    disc.collision_type, disc.filter = shape.collision_type, ORDINARY
    return disc


def core_of(shape: pymunk.Shape) -> list[complex]:
    """Return what is thickened by a shape's radius, along the axes of its body [m]."""
    match shape:
        case pymunk.Circle():
            return [complex(*shape.offset)]
        case pymunk.Segment():
            return [complex(*shape.a), complex(*shape.b)]
        case pymunk.Poly():
            return [complex(*corner) for corner in shape.get_vertices()]
    raise TypeError(f"no core of a {type(shape).__name__}")
