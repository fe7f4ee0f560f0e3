"""The handles of the selection: one rotates it, those of a single body change its shape."""

from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

import pygame

from sandbox.app.building.partial_level import DrawableBody
from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.model.shapes import XY, Arc, Box, Curve

SIZE = 4  # px, half the side of a handle
REACH = 8.0  # px, the distance within which it can be grabbed
STALK = 30.0  # px, the length of the stalk of the rotation handle
TURN = -1
"""The index of the rotation handle; the others are as in `sandbox.editing.edits.resizing`."""

_SIDES = ((-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0))
"""The positions of a box's handles, in halves of its sides."""


@dataclass(frozen=True, slots=True)
class Handle:
    """A handle, and its position on the stage [px]."""

    index: int
    place: XY


def to_plane(body: DrawableBody, local: XY) -> XY:
    """Return the position in the plane of a point in the axes of a body [m]."""
    placed = complex(*body.position) + complex(*local) * rect(1, body.angle)
    return placed.real, placed.imag


def to_body_axes(body: DrawableBody, point: XY) -> XY:
    """Return the position in the axes of a body of a point of the plane [m]."""
    local = (complex(*point) - complex(*body.position)) * rect(1, -body.angle)
    return local.real, local.imag


def size_of(body: DrawableBody) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of a body in its own axes [m]."""
    xs, ys = zip(*body.outline.points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def middle(bodies: Sequence[DrawableBody]) -> XY:
    """Return the point about which bodies are rotated: the middle of several [m]."""
    if len(bodies) == 1:
        return bodies[0].position
    left, low, right, high = _bounds(bodies)
    return (left + right) / 2, (low + high) / 2


def of(bodies: Sequence[DrawableBody], camera: Camera) -> list[Handle]:
    """Return the handles of a body, or of several together."""
    handles = [Handle(TURN, _stalk(bodies, camera)[1])]
    if len(bodies) == 1:
        (body,) = bodies
        places = (camera.to_screen(to_plane(body, local)) for local in _of_shape(body))
        handles += map(Handle, range(len(_of_shape(body))), places)
    return handles


def _of_shape(body: DrawableBody) -> list[XY]:
    """Return the positions of the shape's handles in the axes of the body [m]."""
    points, shape = list(body.outline.points), body.spec.shape
    if body.outline.radius is not None:
        return [(body.outline.radius, 0.0)]
    if isinstance(shape, Curve):  # given by formulas
        return []
    if isinstance(shape, Arc):
        return [points[len(points) // 2]]
    if isinstance(shape, Box):
        _, _, right, top = size_of(body)
        return [(x * right, y * top) for x, y in _SIDES]
    return points


def _bounds(bodies: Sequence[DrawableBody]) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of several bodies in the plane [m]."""
    xs, ys = zip(*(corner for body in bodies for corner in body.corners), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _stalk(bodies: Sequence[DrawableBody], camera: Camera) -> tuple[XY, XY]:
    """Return both ends of the stalk of the rotation handle [px]."""
    if len(bodies) > 1:
        left, _, right, top = _bounds(bodies)
        x, y = camera.to_screen(((left + right) / 2, top))
        return (x, y), (x, y - STALK)
    (body,) = bodies
    left, _, right, top = size_of(body)
    x, y = camera.to_screen(to_plane(body, ((left + right) / 2, top)))
    direction = rect(STALK, body.angle)
    return (x, y), (x - direction.imag, y - direction.real)


def at(handles: list[Handle], pixel: XY) -> Handle | None:
    """Return the handle at a pixel; None if there is none."""
    near = [(hypot(h.place[0] - pixel[0], h.place[1] - pixel[1]), i) for i, h in enumerate(handles)]
    distance, index = min(near)
    return handles[index] if distance <= REACH else None


def draw(surface: pygame.Surface, bodies: Sequence[DrawableBody], camera: Camera) -> None:
    """Draw the handles of a body, or of several together."""
    lines.stroke(surface, theme.ACCENT, *_stalk(bodies, camera), 1)
    for handle in of(bodies, camera):
        if handle.index == TURN:
            pygame.draw.aacircle(surface, theme.STAGE, handle.place, 6)
            pygame.draw.aacircle(surface, theme.ACCENT, handle.place, 5)
        else:
            box = pygame.Rect(0, 0, 2 * SIZE + 1, 2 * SIZE + 1)
            box.center = round(handle.place[0]), round(handle.place[1])
            surface.fill(theme.STAGE, box.inflate(2, 2))
            surface.fill(theme.ACCENT, box)


def dragged(body: DrawableBody, index: int, to: XY) -> list[XY]:
    """Return a body's outline after a handle was moved, in the axes of the body [m]."""
    points, (x, y) = list(body.outline.points), to_body_axes(body, to)
    if isinstance(body.spec.shape, Box):
        _, _, right, top = size_of(body)
        side = _SIDES[index]
        across = _stretched(right, side[0], x)
        upwards = _stretched(top, side[1], y)
        return [(across[px > 0], upwards[py > 0]) for px, py in points]
    if body.outline.radius is not None or isinstance(body.spec.shape, Arc):
        handle = _of_shape(body)[index]
        factor = hypot(x, y) / (hypot(*handle) or 1.0)
        return [(px * factor, py * factor) for px, py in points]
    points[index] = x, y
    return points


def _stretched(half: float, side: int, to: float) -> tuple[float, float]:
    """Return both ends of a box's side after one was moved [m]."""
    return (to if side < 0 else -half), (to if side > 0 else half)
