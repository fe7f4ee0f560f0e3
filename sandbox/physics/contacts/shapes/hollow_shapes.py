"""Makes hollow shapes in pymunk: arcs, curves and hoops, and the feelers of other bodies."""

from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from math import cos, tau

import numpy as np
import pymunk

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.shapes import ROUND_OFF, Box, Disc, Hoop, Polygon
from sandbox.model.shapes import Arc as ArcShape
from sandbox.model.shapes import Curve as CurveShape
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.contacts.shapes.corner_feelers import (
    FELT,
    HOLLOW,
    ORDINARY,
    ShapedBody,
    core_of,
    half_of,
    make_feeler,
)
from sandbox.physics.contacts.shapes.hoop_collision_filter import Enclosures
from sandbox.physics.contacts.shapes.line_end_caps_and_joins import make_ends
from sandbox.physics.engine.pymunk_bodies import center_of, local_points
from sandbox.physics.geometry.arc_contacts import Arc, Piece
from sandbox.physics.geometry.convex_decomposition import convex_parts
from sandbox.physics.geometry.curve_contacts import middle_line_of
from sandbox.physics.geometry.plane_curve import MiddleLine, Side
from sandbox.physics.state.simulation_errors import SimulationError

HollowShape = ArcShape | Hoop | CurveShape
"""Shapes that may be touched from inside."""


def make_hollow(
    space: pymunk.Space,
    level: Level,
    values: Values,
    shapes: Mapping[str, Sequence[pymunk.Shape]],
    skin: float,
    drift: float | None,
) -> Hollows | None:
    """Make the contacts of hollow bodies; None if the level has none.

    All shapes, in the level's order, are in the space already, and were made from `level` and
    `values`. `skin` is the thickness of the contact skin on flat surfaces [m]; for `drift` see
    `Hollows`. Raises `SimulationError` if a body starts in a hoop that can only be touched from
    outside, or if hoops separate too many bodies.
    """
    if not any(isinstance(body.shape, HollowShape) for body in level.bodies.values()):
        return None
    made = {
        name: _made(row, level.bodies[name], values, own)
        for row, (name, own) in enumerate(shapes.items())
        if own  # a sensor has none
    }
    pairs = _pairs(level, values, made)
    return _make(space, made, pairs, values, skin, drift) if pairs else None


def _make(
    space: pymunk.Space,
    made: Mapping[str, ShapedBody],
    pairs: Sequence[tuple[str, str]],
    values: Values,
    skin: float,
    drift: float | None,
) -> Hollows:
    """Make the hollow bodies of some pairs, and the feelers of the others."""
    lines: dict[str, Arc | MiddleLine] = {
        name: line_of(made[name].row, made[name].spec, values, skin)
        for name in dict.fromkeys(hollow for hollow, _ in pairs)
    }
    rows = {(min(pair), max(pair)): frozenset(made[name].row for name in pair) for pair in pairs}
    hollows = Hollows(rows, drift, Enclosures(space, made, lines))
    for shape in space.shapes:
        shape.filter = ORDINARY
    for shape, piece in _pieces(made, lines, values, pairs, skin):
        hollows.know(shape, piece)
    for shape, piece in (*make_ends(made, lines, values, skin), *_feelers(made, pairs, skin)):
        space.add(shape)
        hollows.know(shape, piece)
    return hollows


def _made(row: int, spec: Body, values: Values, shapes: Sequence[pymunk.Shape]) -> ShapedBody:
    body = shapes[0].body
    assert body is not None
    return ShapedBody(
        row, spec, body, shapes, [complex(*point) for point in local_points(spec, values)]
    )


def _pairs(level: Level, values: Values, made: Mapping[str, ShapedBody]) -> list[tuple[str, str]]:
    """Return the pairs of a body that may be touched from inside, and the body that may do so."""
    found = []
    effects = level.effects
    sticky = {frozenset(p.bodies) for p in effects.sticking.pairs} if effects.sticking else set()
    located = effects.contact and effects.contact.located
    moving = {name: body for name, body in made.items() if body.moves}
    widths = {name: _width(body) for name, body in made.items()}
    for name, hollow in made.items():
        if not isinstance(hollow.spec.shape, HollowShape):
            continue
        for other, body in (made if hollow.moves else moving).items():
            if other == name:
                continue
            if isinstance(hollow.spec.shape, Hoop):
                radius = hollow.spec.shape.radius(values)
                if widths[other] >= 2 * radius:
                    continue
                if located or {name, other} in sticky:
                    _refuse_within(name, hollow, radius, other, body)
                    continue
            found.append((name, other))
    return found


def _width(body: ShapedBody) -> float:
    """Return the larger side of a body's bounding box along its own axes [m]."""
    low = np.min([_box(shape)[0] for shape in body.shapes], axis=0)
    high = np.max([_box(shape)[1] for shape in body.shapes], axis=0)
    return float((high - low).max())


def _box(shape: pymunk.Shape) -> tuple[list[float], list[float]]:
    """Return the corners of the bounding box of a shape, along the axes of its body [m]."""
    points, radius = core_of(shape), shape.radius
    x, y = [p.real for p in points], [p.imag for p in points]
    return [min(x) - radius, min(y) - radius], [max(x) + radius, max(y) + radius]


def _refuse_within(
    name: str, hollow: ShapedBody, radius: float, other: str, body: ShapedBody
) -> None:
    """Refuse a body that starts in a hoop, as first contacts from inside are not located."""
    if abs(complex(*hollow.body.position) - complex(*body.body.position)) < radius:
        rule = Message(
            "'{other}' starts in the hoop '{name}', but hoops are touched only from outside if"
            " impacts are located or the two stick; leave out 'located' or 'sticking'",
            other=other,
            name=name,
        )
        raise SimulationError(other, 0.0, rule)


def line_of(row: int, spec: Body, values: Values, skin: float) -> Arc | MiddleLine:
    """Return the line of an arc, a hoop or a curve, along the axes of its body.

    `row` and `spec` are the body's index, and its description in the level; `skin` is the thickness
    of the contact skin [m].
    """
    shape = spec.shape
    if isinstance(shape, CurveShape):
        return middle_line_of(shape, values)
    if isinstance(shape, Hoop):
        radius = shape.radius(values)
        return Arc(row, 0j, radius, radius - skin, radius, 1 + 0j, -2.0)
    assert isinstance(shape, ArcShape)
    radius, half = shape.radius(values), shape.thickness(values) / 2 + skin
    start, end = shape.start(values), shape.end(values)
    whole = end - start >= tau - ROUND_OFF
    return Arc(
        body=row,
        center=center_of(shape, spec, values),
        radius=radius,
        inner=radius - half,
        outer=radius + half,
        middle=rect(1, (start + end) / 2),
        cosine=-2.0 if whole else cos((end - start) / 2),
    )


def _pieces(
    made: Mapping[str, ShapedBody],
    lines: Mapping[str, Arc | MiddleLine],
    values: Values,
    pairs: Sequence[tuple[str, str]],
    skin: float,
) -> Iterator[tuple[pymunk.Shape, Piece]]:
    """Yield the existing shapes with their exact geometry."""
    for name, body in made.items():
        line = lines.get(name)
        for shape in body.shapes if line else ():
            shape.filter = pymunk.ShapeFilter(categories=HOLLOW)
        if isinstance(line, Arc):
            yield body.shapes[0], Piece(body.row, (line.center,), line.outer, line)
        elif line:
            half = half_of(body, values, skin)
            for shape, stretch in zip(body.shapes, line.stretches, strict=True):
                curve = Side(body.row, line, stretch, half)
                yield shape, Piece(body.row, (stretch.center,), stretch.radius, curve=curve)
        elif any(name == other for _, other in pairs):
            for shape, core in zip(body.shapes, _cores(body), strict=True):
                radius = skin if isinstance(shape, pymunk.Poly) else _radius(shape)
                yield shape, Piece(body.row, tuple(core), radius)


def _radius(shape: pymunk.Shape) -> float:
    assert isinstance(shape, pymunk.Circle | pymunk.Segment)
    return shape.radius


def _cores(body: ShapedBody) -> list[list[complex]]:
    """Return the cores of a body's shapes; of polygons, the exact corners.

    Those in pymunk are slightly smaller, because of their radius.
    """
    match body.spec.shape:
        case Box():
            return [list(body.points)]
        case Polygon():
            parts = convex_parts([(point.real, point.imag) for point in body.points])
            return [[complex(*corner) for corner in part] for part in parts]
    return [core_of(shape) for shape in body.shapes]


def _feelers(
    made: Mapping[str, ShapedBody], pairs: Sequence[tuple[str, str]], skin: float
) -> Iterator[tuple[pymunk.Shape, Piece]]:
    """Yield a feeler for each corner that may touch an arc from inside."""
    for other in dict.fromkeys(other for _, other in pairs):
        body = made[other]
        if isinstance(body.spec.shape, Disc | Hoop | ArcShape | CurveShape):
            continue
        known: set[complex] = set()
        for shape, core in zip(body.shapes, _cores(body), strict=True):
            radius = skin if isinstance(shape, pymunk.Poly) else _radius(shape)
            reach = radius + FELT * max(abs(a - b) for a in core for b in core)
            for corner in core:
                if corner not in known:
                    known.add(corner)
                    feeler = make_feeler(shape, corner, reach)
                    yield feeler, Piece(body.row, tuple(core), radius, corner=corner)
