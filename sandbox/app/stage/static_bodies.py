"""Draws static bodies: solid ground, and lines with ground behind them."""

from collections.abc import Sequence
from itertools import groupby, pairwise
from math import ceil, dist

import pygame

from sandbox.app.drawing import lines, shading, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.stage.bodies import draw_area, draw_one_way_arrowheads
from sandbox.app.stage.body_outlines import Outline
from sandbox.model.shapes import XY

HATCH = 9  # px, between strokes
GROUND = 32.0  # px, the depth of the ground behind a line
SHALLOW = 0.3
"""The largest depth of that ground, relative to the line's length."""


def draw_surface(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float,
    inside: XY,
) -> None:  # fmt: skip
    """Draw a static body; a thin line is hatched on the side away from the moving bodies.

    `inside` is a point on the side of the moving bodies [m]. A one-way line has arrows instead, on
    the side from which it lets bodies through.
    """
    if outline.sensor:
        draw_area(surface, camera, outline, position, angle)
        return
    corners = camera.path(outline.placed(position, angle))
    edge = theme.SURFACE_EDGE
    if outline.hollow:
        corners.append(corners[0])
    elif outline.closed:
        shading.solid(surface, outline.color, corners)
        lines.path(surface, edge, [*corners, corners[0]], 2)
        return
    width = max(outline.thickness * camera.scale, 3)
    if outline.one_way:
        lines.path(surface, edge, corners, width)
        draw_one_way_arrowheads(surface, outline, corners, width)
        return
    away = camera.to_screen(inside)
    nearest = min(pairwise(corners), key=lambda piece: dist(piece[0], away))
    _ground(
        surface,
        [
            (*piece, _side(*(nearest if outline.curved else piece), away))
            for piece in pairwise(corners)
            if dist(*piece)
        ],
    )
    lines.path(surface, edge, corners, width)


def _ground(surface: pygame.Surface, pieces: Sequence[tuple[XY, XY, int]]) -> None:
    """Draw hatched ground at each piece of a line, on the opposite of the given side."""
    for side, run in groupby(pieces, key=lambda piece: piece[2]):
        same = list(run)
        corners = [same[0][0], *(end for _, end, _ in same)]
        depth = min(GROUND, SHALLOW * sum(dist(a, b) for a, b in pairwise(corners)))
        shading.bank(surface, theme.SURFACE, corners, side, depth)
    begun = 0.0
    for a, b, side in pieces:
        begun = _hatch(surface, a, b, side, begun)


def _side(a: XY, b: XY, inside: XY) -> int:
    """Return the side of a line on which a point is, 1 or −1."""
    across = (b[0] - a[0]) * (inside[1] - a[1]) - (b[1] - a[1]) * (inside[0] - a[0])
    return 1 if across > 0 else -1


def _hatch(surface: pygame.Surface, a: XY, b: XY, side: int, begun: float) -> float:
    """Hatch the opposite side of a line; return the distance from its end to the next stroke [px].

    The first stroke is at a distance `begun` from the start.
    """
    length = dist(a, b)
    if not length:
        return begun
    ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    first, last = lines.visible_part(surface, a, b)
    for i in range(ceil((first - begun) / HATCH), ceil((last - begun) / HATCH)):
        x, y = a[0] + ux * (begun + i * HATCH), a[1] + uy * (begun + i * HATCH)
        end = x + (uy + ux) * side * HATCH, y + (uy - ux) * side * HATCH
        lines.stroke(surface, theme.SURFACE, (x, y), end, 1)
    return (begun - length) % HATCH
