"""Resizing bodies by the handles of their shapes, and making one round shape another.

A disc has a handle on its rim; a box has one at each corner and in the middle of each side, and the
opposite corner or side stays; lines and polygons have one at each corner. A body that still has the
mass with which it was drawn keeps its density; any other keeps its mass.
"""

import re
from collections.abc import Mapping, Sequence

from sandbox.editing.attached_bodies import attached, shifted_point
from sandbox.editing.bodies_at_start import PlacedBody, placed, xy
from sandbox.editing.cleanup_after_edit import without_meaning
from sandbox.editing.edits.bodies import SMALLEST, drawn_mass
from sandbox.editing.edits.edit_result import EditResult, new_name
from sandbox.editing.edits.field_values import set_field
from sandbox.editing.formula_arithmetic import scaled, towards
from sandbox.editing.inserted_value_layout import Json
from sandbox.editing.renaming import rename
from sandbox.editing.text_patches import Changes, put, put_all, value_at
from sandbox.model.comments import read_level
from sandbox.model.errors import SandboxError
from sandbox.model.json_positions import Path
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
    points_of,
)

ROUND = ("disc", "hoop", "arc")
"""The shapes that are round."""

HALF_PIPE: Mapping[str, Json] = {"start": "180*deg", "end": "360*deg"}
"""The angles of a new arc, which is open at its top."""


_SIDES = (-1 - 1j, 0 - 1j, 1 - 1j, 1 + 0j, 1 + 1j, 0 + 1j, -1 + 1j, -1 + 0j)
"""A box's handles in halves of its sides, counter-clockwise from the lower left."""


def handles(level: Level, name: str) -> list[XY]:
    """Return the positions of the handles of a body in the plane [m]; a curve has none."""
    return [xy(where) for where in _handles(placed(level)[name])]


def drag_handle(text: str, level: Level, name: str, index: int, to: XY) -> str:
    """Return a level in which a handle of a body is dragged to a point, as far as the shape allows.

    The index is that in `handles`. Raises `SandboxError` if the body would have no size.
    """
    body = placed(level)[name]
    changed = put_all(text, _dragged(body, index, complex(*to)))
    lines = isinstance(body.body.shape, Polygon | Segment | Polyline)
    return _settled(changed, level, body, int(index == 0) if lines else None)


def scale(text: str, level: Level, name: str, factor: float) -> str:
    """Return a level in which a body is scaled about its centre.

    Raises `SandboxError` if the body would have no size, or it is a curve, whose formulas give its
    shape.
    """
    body = placed(level)[name]
    if factor <= SMALLEST:
        raise SandboxError("that would leave nothing of it")
    return _settled(put_all(text, _scaled(body, factor)), level, body, None)


def _handles(body: PlacedBody) -> Sequence[complex]:
    match body.body.shape:
        case Disc() | Hoop():
            return [body.to_plane(complex(body.radius))]
        case Box():
            half = body.local[2]
            return [body.to_plane(_of(side, half)) for side in _SIDES]
        case Polygon() | Segment() | Polyline():
            return body.corners
        case Arc():
            return [body.corners[len(body.corners) // 2]]
        case Curve():
            return []


def _of(side: complex, half: complex) -> complex:
    return complex(side.real * half.real, side.imag * half.imag)


def _dragged(body: PlacedBody, index: int, to: complex) -> Changes:
    """Return the changes when a handle is dragged."""
    match body.body.shape:
        case Disc(radius=radius) | Hoop(radius=radius):
            return {_radius(body): towards(radius, _size(abs(to - body.center)), body.values)}
        case Box() as box:
            return _box(body, box, _SIDES[index], body.to_body(to))
        case Polygon() | Segment() | Polyline():
            return _corner(body, index, to)
        case Arc(radius=radius):
            half = _handles(body)[0]
            factor = _size(abs(to - body.center)) / max(abs(half - body.center), SMALLEST)
            return {_radius(body): scaled(radius, factor)}
        case Curve():
            raise SandboxError("the shape of a curve is given by its formulas")


def _box(body: PlacedBody, box: Box, side: complex, to: complex) -> Changes:
    """Return the changes that move one corner or side of a box; the opposite one stays."""
    half = body.local[2]
    away = to + _of(side, half)  # from the opposite side
    path = ("bodies", body.name, "shape")
    changes, middle = Changes(), 0j
    if side.real:
        width = _size(side.real * away.real)
        changes[*path, "width"] = towards(box.width, width, body.values)
        middle += side.real * (width / 2 - half.real)
    if side.imag:
        height = _size(side.imag * away.imag)
        changes[*path, "height"] = towards(box.height, height, body.values)
        middle += 1j * side.imag * (height / 2 - half.imag)
    by = body.rotation * middle
    changes["bodies", body.name, "position"] = shifted_point(body.body.position, by)
    return changes


def _corner(body: PlacedBody, index: int, to: complex) -> Changes:
    """Return the changes that move one corner of a shape."""
    shape = body.body.shape
    assert isinstance(shape, Polygon | Segment | Polyline)
    by = body.to_body(to) - body.local[index]
    return {_paths(body)[index]: shifted_point(points_of(shape)[index], by)}


def _paths(body: PlacedBody) -> list[Path]:
    """Return the paths of the corners of a body in its level."""
    path = ("bodies", body.name, "shape")
    match body.body.shape:
        case Polygon(vertices=corners):
            return [(*path, "vertices", index) for index in range(len(corners))]
        case Polyline(points=corners):
            return [(*path, "points", index) for index in range(len(corners))]
    return [(*path, "start"), (*path, "end")]


def _radius(body: PlacedBody) -> Path:
    return ("bodies", body.name, "shape", "radius")


def _size(value: float) -> float:
    if value <= SMALLEST:
        raise SandboxError("that would leave nothing of it")
    return value


def _scaled(body: PlacedBody, factor: float) -> Changes:
    """Return the changes that scale a body."""
    path = ("bodies", body.name, "shape")
    match body.body.shape:
        case Disc(radius=radius) | Hoop(radius=radius) | Arc(radius=radius):
            return {_radius(body): scaled(radius, factor)}
        case Box(width=width, height=height):
            return {
                (*path, "width"): scaled(width, factor),
                (*path, "height"): scaled(height, factor),
            }
        case Polygon() | Segment() | Polyline() as drawn:
            corners = zip(_paths(body), points_of(drawn), strict=True)
            return {place: [scaled(c, factor) for c in point] for place, point in corners}
        case Curve():
            raise SandboxError("the shape of a curve is given by its formulas")


def _settled(text: str, before: Level, body: PlacedBody, fixed: int | None) -> str:
    """Return a level in which a body with a new shape has the right position and mass.

    A fixed corner stays where it is in the plane, although the centre of mass moves within the
    shape.
    """
    level = read_level(text)
    other = PlacedBody(body.name, level.bodies[body.name], body.values)
    changes = Changes()
    if fixed is not None and (drift := body.local[fixed] - other.local[fixed]):
        position = shifted_point(other.body.position, body.rotation * drift)
        changes["bodies", body.name, "position"] = position
    mass = body.body.mass
    if mass is not None and body.area and mass.source == drawn_mass(body.area):
        changes["bodies", body.name, "mass"] = drawn_mass(other.area)
    return attached(put_all(text, changes), before, [body.name])


def rounded(text: str, level: Level, name: str, kind: str) -> EditResult:
    """Return a level in which a round body is a disc, a hoop or an arc, of the same radius.

    A new arc is the lower half of the circle, and static. An arc that becomes a disc or hoop is
    made dynamic, with the mass of a drawn body. An automatic name, such as `disc1`, is replaced by
    one for the new shape. Raises `LevelError` if the loader refuses it.
    """
    path, before = ("bodies", name), level.bodies[name]
    if before.shape.type == kind:
        return EditResult(text, (name,))
    radius = value_at(text, (*path, "shape", "radius"))
    shape = {"type": kind, "radius": radius, **(HALF_PIPE if kind == "arc" else {})}
    changed = without_meaning(put(text, (*path, "shape"), shape))
    if kind == "arc" and before.type == "dynamic":
        changed = set_field(changed, (*path, "type"), "static")
    elif before.shape.type == "arc" and before.type == "static":
        changed = set_field(changed, (*path, "type"), "dynamic")
    if re.fullmatch(rf"{before.shape.type}\d+", name):
        called = new_name(kind, level)
        return EditResult(rename(changed, path, called), (called,))
    return EditResult(changed, (name,))
