"""Adding bodies that were drawn, and deleting bodies.

All drawn bodies have the same density, 10 kg/m². With a new body, the effects that it needs are
declared: gravity and contact if nothing is declared yet; and it gets each coefficient that every
body has.
"""

from collections.abc import Mapping, Sequence
from math import pi

import numpy as np

from sandbox.editing.cleanup_after_edit import COEFFICIENTS, first_valid, without_meaning
from sandbox.editing.drawn_outlines import centroid, simplified
from sandbox.editing.edits.automatic_title import without_empty_summary
from sandbox.editing.edits.edit_result import EditResult, new_name
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put, put_all, remove
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.shapes import XY

DENSITY = 10.0
"""kg/m², the density of drawn bodies; a box of 0.3 m has about 1 kg."""

SMALLEST = 1e-12
"""m, the largest size that is taken for a click, and makes no body."""

DRAWN = 12
"""The significant digits of a drawn size: the last digits of a difference are rounding errors."""

CLOSES = 0.1
"""The largest gap between the ends of a closed stroke, as a share of its size."""

GRAVITY: Json = {"acceleration": [0, -9.81]}


def add_disc(text: str, level: Level, center: XY, rim: XY) -> EditResult:
    """Return a level with a new disc, given its centre and a point of its rim."""
    radius = _size(abs(complex(*rim) - complex(*center)))
    shape: Json = {"type": "disc", "radius": radius}
    return _add_dynamic(text, level, "disc", shape, center, pi * radius**2)


def add_box(text: str, level: Level, corner: XY, opposite: XY) -> EditResult:
    """Return a level with a new box, given two opposite corners."""
    (x, y), (u, v) = corner, opposite
    width, height = _size(abs(u - x)), _size(abs(v - y))
    shape: Json = {"type": "box", "width": width, "height": height}
    return _add_dynamic(text, level, "box", shape, ((x + u) / 2, (y + v) / 2), width * height)


def add_polygon(text: str, level: Level, points: Sequence[XY]) -> EditResult:
    """Return a level with a new polygon, through at least three points in order.

    Raises `SandboxError` if it has no area.
    """
    area, center = centroid(points)
    if area <= SMALLEST**2:
        raise SandboxError("a polygon needs three corners that are not in one line")
    # from the first corner, for short numbers; the origin of a dynamic body is its centre of mass
    shape: Json = {"type": "polygon", "vertices": _about(points, points[0])}
    return _add_dynamic(text, level, "polygon", shape, center, area)


def add_surface(text: str, level: Level, points: Sequence[XY]) -> EditResult:
    """Return a level with a new static line: a floor, a slope or a wall.

    Raises `SandboxError` if it has no length.
    """
    if len(points) < 2 or max(abs(complex(*p) - complex(*points[0])) for p in points) <= SMALLEST:
        raise SandboxError("a surface needs two points that are apart")
    middle = (float(np.mean([x for x, _ in points])), float(np.mean([y for _, y in points])))
    local = _about(points, middle)
    shape: dict[str, Json] = {"type": "polyline", "points": local}
    if len(points) == 2:
        shape = {"type": "segment", "start": local[0], "end": local[1]}
    body: dict[str, Json] = {"type": "static", "shape": shape, "position": list(middle)}
    return _add(text, level, "surface", body)


def add_curve(text: str, level: Level, points: Sequence[XY], tolerance: float) -> EditResult:
    """Return a level with the shape of a stroke: a polygon if it is closed, else a static line.

    The simplified line keeps within the tolerance of the points [m], a pixel or two.
    """
    size = float(np.ptp(np.array(points), axis=0).max())
    open_ends = abs(complex(*points[-1]) - complex(*points[0]))
    if len(points) > 3 and open_ends <= max(CLOSES * size, tolerance):
        return add_polygon(text, level, simplified(points, tolerance, closed=True))
    return add_surface(text, level, simplified(points, tolerance, closed=False))


def remove_parts(text: str, level: Level, names: Sequence[str]) -> str:
    """Return a level without some bodies or joints, and without parts that then have no meaning.

    With a body its joints are removed, and so are checks, effects and parameters that are no longer
    about anything. Raises `SandboxError` if no body would be left.
    """
    if not set(level.bodies).difference(names):
        raise SandboxError("a level needs a body; draw another one first")
    for name in names:
        text = remove(text, ("bodies" if name in level.bodies else "joints", name))
    return without_meaning(text)


def _add_dynamic(
    text: str, level: Level, kind: str, shape: Json, center: XY, area: float
) -> EditResult:
    body = {"shape": shape, "mass": drawn_mass(area), "position": list(center)}
    return _add(text, level, kind, body)


def drawn_mass(area: float) -> float:
    """Return the mass of a drawn area [kg], to three significant digits."""
    return plain(float(f"{DENSITY * area:.3g}"))


def _add(text: str, level: Level, kind: str, body: Mapping[str, Json]) -> EditResult:
    name = new_name(kind, level)
    text = without_empty_summary(text)
    text = put(text, ("bodies", name), {**body, **_coefficients(level)})
    return EditResult(first_valid(_declaring(text, level), text), (name,))


def _coefficients(level: Level) -> dict[str, Json]:
    """Return the coefficients that every body of a level needs; 1 keeps that of the other body."""
    return {kind: 1 for kind in COEFFICIENTS if getattr(level.effects, kind)}


def _declaring(text: str, level: Level) -> list[str]:
    """Return variants of a level that declare effects for a new body, the most first.

    Gravity and contact are declared if there is no dynamic body and no effect yet; contact alone if
    there was only one body.
    """
    missing: dict[str, Json] = {}
    still = all(body.type != "dynamic" for body in level.bodies.values())
    fresh = still and not level.effects.declared
    if fresh:
        missing["gravity"] = GRAVITY
    if level.effects.contact is None and (fresh or len(level.bodies) == 1):
        missing["contact"] = {}
    declared = [(("effects", name), settings) for name, settings in missing.items()]
    return [put_all(text, dict(declared[:count])) for count in range(len(declared), 0, -1)]


def _about(points: Sequence[XY], center: XY) -> list[list[float]]:
    return [[x - center[0], y - center[1]] for x, y in points]


def _size(value: float) -> float:
    if value <= SMALLEST:
        raise SandboxError("drag to give it a size")
    return float(f"{value:.{DRAWN}g}")
