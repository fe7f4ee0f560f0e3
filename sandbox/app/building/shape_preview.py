"""Previews of the shape under construction: dashed outlines, points, and measures."""

from collections.abc import Sequence

import pygame

from sandbox.app.building.mouse_position import SnappedPoint
from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.app.words.language import say
from sandbox.model.shapes import XY

MARK = 6.0  # px, the radius of the mark where a point snapped
ASIDE = 16  # px, from the mouse to the text beside it


def metres(value: float) -> str:
    """Return a length as text, to four digits."""
    return f"{number(value, 4)} m"


def outline(
    surface: pygame.Surface, camera: Camera, points: Sequence[XY], *, closed: bool = False
) -> None:
    """Draw a dashed line through points of the plane [m]."""
    corners = camera.path(points)
    if closed and corners:
        corners.append(corners[0])
    if len(corners) > 1:
        lines.dashed(surface, theme.ACCENT, corners)


def mark_points(surface: pygame.Surface, camera: Camera, points: Sequence[XY]) -> None:
    """Mark points that were set [m]."""
    for place in camera.path(points):
        pygame.draw.aacircle(surface, theme.STAGE, place, 5)
        pygame.draw.aacircle(surface, theme.ACCENT, place, 4)


def write_measure(surface: pygame.Surface, pen: Pen, pixel: XY, text: str) -> None:
    """Write a measure beside the mouse, on a background."""
    line = pen.write(text, 13)
    box = line.get_rect(topleft=(round(pixel[0]) + ASIDE, round(pixel[1]) + ASIDE)).inflate(12, 6)
    box.clamp_ip(surface.get_rect())
    pygame.draw.rect(surface, theme.RAISED, box, border_radius=4)
    pygame.draw.rect(surface, theme.EDGE, box, 1, border_radius=4)
    surface.blit(line, line.get_rect(center=box.center))


def mark_snapped(surface: pygame.Surface, camera: Camera, pen: Pen, snapped: SnappedPoint) -> None:
    """Mark a point that snapped, and write what it snapped to unless that is the grid."""
    if not snapped.snapped_to:
        return
    x, y = camera.to_screen(snapped.point)
    if snapped.snapped_to == "grid":
        lines.cross(surface, theme.NOTICE, (x, y), MARK, 1)
        return
    pygame.draw.aacircle(surface, theme.NOTICE, (x, y), MARK, 2)
    text = pen.outlined(say(snapped.snapped_to))
    surface.blit(text, text.get_rect(midbottom=(round(x), round(y) - 10)))
