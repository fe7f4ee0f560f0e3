"""The positions and outlines of a level's bodies at the start."""

from cmath import rect
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi

import numpy as np

from sandbox.model.body import Body
from sandbox.model.errors import SandboxError
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
)
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.convex_decomposition import convex_parts, twice_area
from sandbox.physics.geometry.outline_distance import gap

Core = tuple[complex, ...]
"""A point, a line or a convex polygon, counter-clockwise [m]."""


@dataclass(frozen=True)
class PlacedBody:
    """A body at the start of a run."""

    name: str
    body: Body
    """The name of the body, and the body."""
    values: Values
    """The values of the parameters."""

    @cached_property
    def center(self) -> complex:
        """Its position [m]."""
        return complex(*evaluate(self.body.position, self.values))

    @cached_property
    def rotation(self) -> complex:
        """The unit vector along the x axis of the body."""
        return rect(1, self.body.angle(self.values))

    @cached_property
    def local(self) -> tuple[complex, ...]:
        """Its corners in the axes of the body [m]; none for a disc."""
        return tuple(complex(*point) for point in local_points(self.body, self.values))

    @cached_property
    def corners(self) -> tuple[complex, ...]:
        """Its corners in the plane [m]."""
        return tuple(map(self.to_plane, self.local))

    @cached_property
    def radius(self) -> float:
        """The distance of its outline from its cores [m]: the radius, half the thickness, or 0."""
        match self.body.shape:
            case Disc(radius=radius) | Hoop(radius=radius):
                return radius(self.values)
            case Box() | Polygon():
                return 0.0
            case Segment() | Polyline() | Arc() | Curve() as line:
                return line.thickness(self.values) / 2

    @cached_property
    def cores(self) -> tuple[Core, ...]:
        """The convex cores, from which its outline is `radius` away, in the plane [m]."""
        match self.body.shape:
            case Disc() | Hoop():
                return ((self.center,),)
            case Box():
                return (self.corners,)
            case Polygon():
                parts = convex_parts([xy(point) for point in self.local])
                return tuple(tuple(self.to_plane(complex(*p)) for p in part) for part in parts)
        return tuple(pairwise(self.corners))

    @property
    def area(self) -> float:
        """Its area [m²]; 0 for a hoop or a line."""
        match self.body.shape:
            case Disc(radius=radius):
                return pi * radius(self.values) ** 2
            case Box() | Polygon():
                return abs(twice_area(np.array([xy(point) for point in self.local]))) / 2
        return 0.0

    @property
    def bounds(self) -> tuple[complex, complex]:
        """The lower left and the upper right corner of its bounding box [m]."""
        points = self.corners or (self.center,)
        left, right = min(p.real for p in points), max(p.real for p in points)
        low, high = min(p.imag for p in points), max(p.imag for p in points)
        reach = complex(self.radius, self.radius)
        return complex(left, low) - reach, complex(right, high) + reach

    def to_plane(self, point: complex) -> complex:
        """Return the position in the plane of a point in the axes of the body [m]."""
        return self.center + self.rotation * point

    def to_body(self, point: complex) -> complex:
        """Return the position in the axes of the body of a point of the plane [m]."""
        return (point - self.center) / self.rotation


def distance(one: PlacedBody, other: PlacedBody, displacement: complex = 0j) -> float:
    """Return the gap between a displaced body and another [m]; negative if they overlap."""
    radii = one.radius + other.radius
    displaced = [tuple(point + displacement for point in core) for core in one.cores]
    return min(gap(core, against, radii).distance for core in displaced for against in other.cores)


def placed(level: Level) -> dict[str, PlacedBody]:
    """Return all bodies of a level at its start; those of the last level are cached."""
    global _last
    if _last is None or _last[0] is not level:
        values = level.defaults
        _last = level, {name: PlacedBody(name, body, values) for name, body in level.bodies.items()}
    return dict(_last[1])


def bodies_named(level: Level, names: Iterable[str]) -> dict[str, PlacedBody]:
    """Return some bodies of a level at its start; raise `SandboxError` if there are no names."""
    where = placed(level)
    found = {name: where[name] for name in names}
    if not found:
        raise SandboxError("choose the bodies first")
    return found


_last: tuple[Level, dict[str, PlacedBody]] | None = None


def bounding_box(bodies: Iterable[PlacedBody]) -> tuple[complex, complex]:
    """Return the lower left and the upper right corner of the bounding box of bodies [m]."""
    boxes = [body.bounds for body in bodies]
    low = complex(min(a.real for a, _ in boxes), min(a.imag for a, _ in boxes))
    return low, complex(max(b.real for _, b in boxes), max(b.imag for _, b in boxes))


def xy(point: complex) -> XY:
    """Return the coordinates of a point."""
    return point.real, point.imag
