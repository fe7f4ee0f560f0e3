"""The shapes of a level's bodies as they are drawn and clicked on."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import cos, hypot, pi, sin

import numpy as np

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.shapes import XY, Arc, Curve, Disc, Hoop, Polyline, Segment
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.depth_in_polygon import depth

CORNERS_OF_A_CIRCLE = 48

LETS = {None: 0, "left": 1, "right": -1}
"""The value of `Outline.lets` for each `one_way` of a body."""

RIM = 6
"""The radius of a hoop relative to the drawn width of its rim."""


@dataclass(frozen=True, slots=True)
class Outline:
    """A body's shape, relative to its position and angle."""

    name: str
    row: int
    """The index of the body in a snapshot's arrays."""
    moves: bool
    """Whether the body is dynamic or kinematic."""
    is_dynamic: bool
    """Whether the body is dynamic, so that the user can move it."""
    color: Color
    radius: float | None
    """The radius of a disc or hoop [m]; None for shapes with corners."""
    points: tuple[XY, ...]
    """The corners [m]; for a circle, those of an inscribed polygon."""
    closed: bool
    """Whether the last corner is connected to the first."""
    curved: bool
    """Whether the body is a curve, which is hatched on the same side all along."""
    hollow: bool
    """Whether only the rim is drawn."""
    thickness: float
    """The thickness of a line [m]."""
    sensor: bool = False
    """Whether the body is an area that others pass through."""
    one_way: int = 0
    """The direction in which a one-way line lets bodies through: 1 to the left, −1 to the right; 0
    for other bodies."""
    hidden: bool = False
    """Whether the body is left out of the picture."""
    layer: int = 0
    """Bodies with a higher value are drawn over those with a lower one."""

    def placed(self, position: XY, angle: float) -> list[XY]:
        """Return the corners in the plane [m]."""
        c, s = cos(angle), sin(angle)
        px, py = position
        return [(px + c * x - s * y, py + s * x + c * y) for x, y in self.points]

    def covers(self, offset: XY, angle: float, margin: float) -> bool:
        """Whether a point, relative to the body's position, is within a margin of the body [m].

        The angle is that of the body [rad].
        """
        c, s = cos(angle), sin(angle)
        x, y = c * offset[0] + s * offset[1], c * offset[1] - s * offset[0]
        if self.radius is not None:
            within = self.radius * (1 - 1 / RIM) - margin if self.hollow else 0.0
            return within <= hypot(x, y) <= self.radius + margin
        near = margin + self.thickness / 2
        if not self.closed:
            return min(lines.distance(a, b, (x, y)) for a, b in pairwise(self.points)) <= near
        if hypot(x, y) > near + max(hypot(*corner) for corner in self.points):
            return False
        corners = np.array([complex(*corner) for corner in self.points])
        return bool(depth(np.array(complex(x, y)), corners) >= -near)


def outlines(level: Level, values: Values) -> Mapping[str, Outline]:
    """Return the outline of every body of a level."""
    found: dict[str, Outline] = {}
    moving = 0
    for row, (name, spec) in enumerate(level.bodies.items()):
        moves = spec.type != "static"
        found[name] = outlined(name, row, spec, values, moving)
        moving += moves
    return found


def outlined(name: str, row: int, spec: Body, values: Values, moving: int) -> Outline:
    """Return the outline of a body; `moving` is the number of moving bodies before it."""
    shape = spec.shape
    radius = shape.radius(values) if isinstance(shape, Disc | Hoop) else None
    line = shape if isinstance(shape, Segment | Polyline | Arc | Curve) else None
    return Outline(
        name=name,
        row=row,
        moves=spec.type != "static",
        is_dynamic=spec.type == "dynamic",
        color=_color(spec, moving),
        radius=radius,
        points=tuple(local_points(spec, values) if radius is None else _circle(radius)),
        closed=line is None,
        curved=isinstance(shape, Curve),
        hollow=isinstance(shape, Hoop),
        thickness=line.thickness(values) if line else 0.0,
        sensor=spec.sensor,
        one_way=LETS[spec.one_way],
        hidden=spec.hidden,
        layer=spec.layer,
    )


def _color(spec: Body, number: int) -> Color:
    if spec.color is not None:
        return theme.parse(spec.color)
    if spec.type == "static":
        return theme.SURFACE
    return theme.BODIES[number % len(theme.BODIES)]


@lru_cache(maxsize=1000)
def _circle(radius: float) -> tuple[XY, ...]:
    turns = (2 * pi * i / CORNERS_OF_A_CIRCLE for i in range(CORNERS_OF_A_CIRCLE))
    return tuple((radius * cos(turn), radius * sin(turn)) for turn in turns)
