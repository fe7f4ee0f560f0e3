"""Draws bodies and surfaces."""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil, cos, dist, sin

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.outline import RIM, Outline
from sandbox.model.shapes import XY

FEW = 200
"""The largest number of bodies that are drawn with smooth rims."""

LEAST = 3.0  # px, the least radius of a disc
HATCH = 9  # px, between strokes
LET = 24.0  # px, the approximate distance between the arrowheads of a one-way surface
WEDGE = 10.0, 2.0, 6.0  # px, of an arrowhead: from the surface to base and tip, half its width
VEIL = 45
"""The opacity of a sensor, from 0 to 255."""


def draw_body(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float,
    spoke: bool,
) -> None:  # fmt: skip
    """Draw a moving body; a disc that can turn is drawn with a spoke."""
    if outline.sensor:
        draw_area(surface, camera, outline, position, angle)
        return
    rim = theme.mix(outline.color, theme.TEXT, 0.45)
    if outline.radius is not None:
        _disc(surface, camera, outline, position, rim)
        if spoke:
            x, y = outline.radius * cos(angle), outline.radius * sin(angle)
            start, end = camera.path((position, (position[0] + x, position[1] + y)))
            lines.stroke(surface, rim if outline.hollow else theme.STAGE, start, end, 2)
        return
    corners = camera.path(outline.placed(position, angle))
    if not outline.closed:
        width = max(outline.thickness * camera.scale, 4)
        lines.path(surface, outline.color, corners, width)
        _let(surface, outline, corners, width)
    else:
        lines.fill(surface, outline.color, corners, rim)


def _disc(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, rim: Color
) -> None:
    assert outline.radius is not None
    center = camera.to_screen(position)
    radius = max(outline.radius * camera.scale, LEAST)
    if not lines.near((center,)) or radius > lines.FAR:
        return
    width = max(round(radius / RIM), 2) if outline.hollow else 0
    pygame.draw.aacircle(surface, outline.color, center, radius, width)
    if not outline.hollow and radius > 5:
        pygame.draw.aacircle(surface, rim, center, radius, 1)


def draw_area(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float
) -> None:
    """Draw a sensor: a translucent area with a dashed outline."""
    corners = camera.path(outline.placed(position, angle))
    if not lines.near(corners):
        return
    (left, *_, right), (top, *_, bottom) = map(sorted, zip(*corners, strict=True))
    seen = pygame.Rect(left, top, right - left + 1, bottom - top + 1).clip(surface.get_rect())
    if seen.size == (0, 0):
        return
    veil = pygame.Surface(seen.size, pygame.SRCALPHA)
    inside = [(x - seen.left, y - seen.top) for x, y in corners]
    pygame.draw.polygon(veil, (*outline.color, VEIL), inside)
    surface.blit(veil, seen)
    lines.dashed(surface, outline.color, [*corners, corners[0]], 7, 5)


def draw_crowd(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float
) -> None:
    """Draw one of very many bodies, as cheaply as possible."""
    if outline.radius is not None:
        center = camera.to_screen(position)
        if lines.near((center,)):
            radius = max(outline.radius * camera.scale, 1)
            pygame.draw.circle(surface, outline.color, center, radius)
        return
    corners = camera.path(outline.placed(position, angle))
    if lines.near(corners) and outline.closed:
        pygame.draw.polygon(surface, outline.color, corners)
    elif lines.near(corners):
        pygame.draw.lines(surface, outline.color, False, corners, 2)


def draw_surface(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float,
    inside: XY,
) -> None:  # fmt: skip
    """Draw a static body; a thin line is hatched on the side away from the moving bodies.

    A one-way line has arrows instead, on the side from which it lets bodies through.

    Parameters
    ----------
    inside
        A point on the side of the moving bodies [m].
    """
    if outline.sensor:
        draw_area(surface, camera, outline, position, angle)
        return
    corners = camera.path(outline.placed(position, angle))
    edge = theme.SURFACE_EDGE
    if outline.hollow:
        corners.append(corners[0])
    elif outline.closed:
        lines.fill(surface, outline.color, corners)
        if outline.radius is None:
            lines.path(surface, edge, [*corners, corners[0]], 2)
        return
    width = max(outline.thickness * camera.scale, 3)
    if outline.lets:
        lines.path(surface, edge, corners, width)
        _let(surface, outline, corners, width)
        return
    away, begun = camera.to_screen(inside), 0.0
    nearest = min(pairwise(corners), key=lambda piece: dist(piece[0], away))
    for a, b in pairwise(corners):
        side = _side(*(nearest if outline.curved else (a, b)), away)
        begun = _hatch(surface, a, b, side, begun)
    lines.path(surface, edge, corners, width)


def _let(surface: pygame.Surface, outline: Outline, corners: Sequence[XY], width: float) -> None:
    """Draw arrowheads towards a one-way line, on the side from which it lets bodies through."""
    length = sum(dist(a, b) for a, b in pairwise(corners)) if outline.lets else 0.0
    apart = length / max(round(length / LET), 1)
    begun = apart / 2
    for a, b in pairwise(corners) if length else ():
        if not (piece := dist(a, b)):
            continue
        ux, uy = (b[0] - a[0]) / piece, (b[1] - a[1]) / piece
        wx, wy = uy * outline.lets, -ux * outline.lets
        first, last = lines.seen(surface, a, b)
        for i in range(ceil((first - begun) / apart), ceil((last - begun) / apart)):
            along = begun + i * apart
            x, y = a[0] + ux * along - wx * (width / 2), a[1] + uy * along - wy * (width / 2)
            _wedge(surface, (x, y), (wx, wy))
        begun = (begun - piece) % apart


def _wedge(surface: pygame.Surface, place: XY, way: XY) -> None:
    """Draw an arrowhead along a unit vector, with its tip just before a point."""
    (x, y), (wx, wy) = place, way
    base = x - wx * WEDGE[0], y - wy * WEDGE[0]
    side = -wy * WEDGE[2], wx * WEDGE[2]
    corners = [
        (base[0] + side[0], base[1] + side[1]),
        (x - wx * WEDGE[1], y - wy * WEDGE[1]),
        (base[0] - side[0], base[1] - side[1]),
    ]
    lines.fill(surface, theme.SURFACE_EDGE, corners)


def _side(a: XY, b: XY, inside: XY) -> int:
    """Return the side of a line on which a point is, 1 or −1."""
    across = (b[0] - a[0]) * (inside[1] - a[1]) - (b[1] - a[1]) * (inside[0] - a[0])
    return 1 if across > 0 else -1


def _hatch(surface: pygame.Surface, a: XY, b: XY, side: int, begun: float) -> float:
    """Hatch the opposite side of a line; return the distance from its end to the next stroke [px].

    Parameters
    ----------
    begun
        The distance from the start of the line to the first stroke [px].
    """
    length = dist(a, b)
    if not length:
        return begun
    ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    first, last = lines.seen(surface, a, b)
    for i in range(ceil((first - begun) / HATCH), ceil((last - begun) / HATCH)):
        x, y = a[0] + ux * (begun + i * HATCH), a[1] + uy * (begun + i * HATCH)
        end = x + (uy + ux) * side * HATCH, y + (uy - ux) * side * HATCH
        lines.stroke(surface, theme.SURFACE, (x, y), end, 1)
    return (begun - length) % HATCH
