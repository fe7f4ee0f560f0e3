"""Draws moving bodies."""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil, cos, dist, sin, tau

import pygame

from sandbox.app.drawing import lines, shading, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.body_outlines import RIM, Outline
from sandbox.model.shapes import XY

FEW = 200
"""The largest number of bodies that are drawn with smooth rims."""

LEAST = 3.0  # px, the least radius of a disc
BEVEL = 2  # px, the width of a lit or shaded edge
SPOKES = 4
"""The number of spokes of a wheel that is not small."""
SMALL = 12.0  # px, the size below which bodies are drawn with less detail
FAINT = 0.35
"""The share of the colour of the bold spoke in fainter ones."""
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
            _spokes(surface, camera, outline, position, angle, rim)
        return
    corners = camera.path(outline.placed(position, angle))
    if not outline.closed:
        width = max(outline.thickness * camera.scale, 4)
        lines.path(surface, outline.color, corners, width)
        draw_one_way_arrowheads(surface, outline, corners, width)
    else:
        _polygon(surface, outline.color, corners, rim)


def _polygon(surface: pygame.Surface, color: Color, corners: Sequence[XY], rim: Color) -> None:
    """Draw a polygon with lit and shaded edges, if it is large enough for those."""
    xs, ys = zip(*corners, strict=True)
    if min(max(xs) - min(xs), max(ys) - min(ys)) < SMALL or not lines.are_close(corners):
        lines.fill(surface, color, corners, rim)
        return
    lines.polygon(surface, color, corners)
    shading.bevel(surface, rim, corners, BEVEL)


def _spokes(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float,
    rim: Color,
) -> None:  # fmt: skip
    """Draw the spoke that shows the angle of a wheel, and fainter ones."""
    assert outline.radius is not None
    bold = rim if outline.hollow else theme.contrasting(outline.color)
    faint = theme.mix(outline.color, bold, FAINT)
    center, radius = camera.to_screen(position), outline.radius * camera.scale
    spokes = SPOKES if radius > SMALL else 1
    for i in reversed(range(spokes)):
        turn = angle + tau * i / spokes
        end = center[0] + radius * cos(turn), center[1] - radius * sin(turn)
        lines.stroke(surface, faint if i else bold, center, end, 1 if i else 2)


def _disc(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, rim: Color
) -> None:
    assert outline.radius is not None
    center = camera.to_screen(position)
    radius = max(outline.radius * camera.scale, LEAST)
    if not lines.are_close((center,)) or radius > lines.FAR:
        return
    if outline.hollow:
        width = max(round(radius / RIM), 2)
        pygame.draw.aacircle(surface, outline.color, center, radius, width)
        return
    shading.disc(surface, outline.color, center, radius)
    if radius > 5:
        pygame.draw.aacircle(surface, rim, center, radius, 1)


def draw_area(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float
) -> None:
    """Draw a sensor: a translucent area with a dashed outline."""
    corners = camera.path(outline.placed(position, angle))
    if not lines.are_close(corners):
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
        if lines.are_close((center,)):
            radius = max(outline.radius * camera.scale, 1)
            pygame.draw.circle(surface, outline.color, center, radius)
        return
    corners = camera.path(outline.placed(position, angle))
    if lines.are_close(corners) and outline.closed:
        pygame.draw.polygon(surface, outline.color, corners)
    elif lines.are_close(corners):
        pygame.draw.lines(surface, outline.color, False, corners, 2)


def draw_one_way_arrowheads(
    surface: pygame.Surface, outline: Outline, corners: Sequence[XY], width: float
) -> None:
    """Draw arrowheads towards a one-way line, on the side from which it lets bodies through."""
    length = sum(dist(a, b) for a, b in pairwise(corners)) if outline.one_way else 0.0
    apart = length / max(round(length / LET), 1)
    begun = apart / 2
    for a, b in pairwise(corners) if length else ():
        if not (piece := dist(a, b)):
            continue
        ux, uy = (b[0] - a[0]) / piece, (b[1] - a[1]) / piece
        wx, wy = uy * outline.one_way, -ux * outline.one_way
        first, last = lines.visible_part(surface, a, b)
        for i in range(ceil((first - begun) / apart), ceil((last - begun) / apart)):
            along = begun + i * apart
            x, y = a[0] + ux * along - wx * (width / 2), a[1] + uy * along - wy * (width / 2)
            _arrowhead(surface, (x, y), (wx, wy))
        begun = (begun - piece) % apart


def _arrowhead(surface: pygame.Surface, place: XY, direction: XY) -> None:
    """Draw an arrowhead along a unit vector, with its tip just before a point."""
    (x, y), (wx, wy) = place, direction
    base = x - wx * WEDGE[0], y - wy * WEDGE[0]
    side = -wy * WEDGE[2], wx * WEDGE[2]
    corners = [
        (base[0] + side[0], base[1] + side[1]),
        (x - wx * WEDGE[1], y - wy * WEDGE[1]),
        (base[0] - side[0], base[1] - side[1]),
    ]
    lines.fill(surface, theme.SURFACE_EDGE, corners)
