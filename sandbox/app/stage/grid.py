"""Draws the grid, the rulers along two edges, and the scale bar."""

from math import ceil, floor

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import MINUS, nice

MINOR = 22  # px, the least distance between two lines
LABELLED = 75  # px, the least distance between two numbers
RULER = 20  # px, the width of a ruler
LONG, SHORT = 8, 4  # px, the lengths of a ruler's ticks
BAR = 130  # px, the greatest length of the scale bar


def draw_grid(surface: pygame.Surface, camera: Camera) -> None:
    """Draw the lines of the grid, with brighter axes through the origin."""
    minor, major = spacing(camera)
    for apart, color in ((minor, theme.GRID), (major, theme.GRID_STRONG)):
        for x in _marks(camera, apart, 0):
            _vertical(surface, camera, x, color)
        for y in _marks(camera, apart, 1):
            _horizontal(surface, camera, y, color)
    _vertical(surface, camera, 0.0, theme.AXIS)
    _horizontal(surface, camera, 0.0, theme.AXIS)


def inside(camera: Camera, pen: Pen) -> pygame.Rect:
    """Return the area of the picture without its rulers [px]."""
    side, (width, height) = _side(camera, spacing(camera)[1], pen), camera.size
    return pygame.Rect(side, 0, width - side, height - pen.px(RULER))


def draw_rulers(surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
    """Draw the rulers along the left and the lower edge, in metres."""
    minor, major = spacing(camera)
    width, height = camera.size
    side, ruler = _side(camera, major, pen), pen.px(RULER)
    shade = theme.mix(theme.STAGE, theme.PANEL, 0.7)
    surface.fill(shade, (0, height - ruler, width, ruler))
    surface.fill(shade, (0, 0, side, height))
    for apart, tick in ((minor, SHORT), (major, LONG)):
        for x in _marks(camera, apart, 0):
            px = round(camera.to_screen((x, 0))[0])
            pygame.draw.line(surface, theme.AXIS, (px, height - ruler), (px, height - ruler + tick))
        for y in _marks(camera, apart, 1):
            py = round(camera.to_screen((0, y))[1])
            pygame.draw.line(surface, theme.AXIS, (side - tick, py), (side, py))
    _write_marks(surface, camera, pen, major, side)
    corner = pygame.Rect(0, height - ruler, side, ruler)
    surface.fill(shade, corner)
    text = pen.write("m", 11, theme.DIM, bold=True)
    surface.blit(text, text.get_rect(center=corner.center))


def _write_marks(
    surface: pygame.Surface, camera: Camera, pen: Pen, major: float, side: int
) -> None:
    """Write the numbers that fit completely; the corner is kept free for the unit."""
    (width, height), ruler = camera.size, pen.px(RULER)
    for x in _marks(camera, major, 0):
        text = pen.write(_mark(x), 11, theme.DIM)
        place = text.get_rect(topleft=(round(camera.to_screen((x, 0))[0]) + 4, height - ruler + 3))
        if side <= place.left and place.right <= width:
            surface.blit(text, place)
    for y in _marks(camera, major, 1):
        text = pen.write(_mark(y), 11, theme.DIM)
        place = text.get_rect(midright=(side - LONG - 3, round(camera.to_screen((0, y))[1])))
        if place.top >= 0 and place.bottom <= height - ruler:
            surface.blit(text, place)


def draw_scale_bar(surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
    """Draw a scale bar of a round length in the lower right corner."""
    metres = nice(pen.px(BAR) / camera.scale)
    length = round(metres * camera.scale)
    left, y = camera.size[0] - length - 16, camera.size[1] - pen.px(RULER) - 16
    for i in range(10):
        start, end = left + round(i * length / 10), left + round((i + 1) * length / 10)
        color = theme.TEXT if i % 2 == 0 else theme.AXIS
        surface.fill(color, (start, y, end - start, 5))
    text = pen.write(f"{metres:g} m", 12, theme.TEXT)
    surface.blit(text, (left + (length - text.width) // 2, y - text.height - 1))


def spacing(camera: Camera) -> tuple[float, float]:
    """Return the distances between thin lines and between numbered lines [m]."""
    major = nice(LABELLED * 2.5 / camera.scale)
    minor = next(m for m in (major / 10, major / 5, major / 2, major) if m * camera.scale >= MINOR)
    return minor, major


def _marks(camera: Camera, spacing: float, axis: int) -> list[float]:
    bounds = camera.bounds
    low, high = bounds[axis], bounds[axis + 2]
    return [i * spacing for i in range(ceil(low / spacing), floor(high / spacing) + 1)]


def _mark(value: float) -> str:
    return f"{round(value, 9):.10g}".replace("-", MINUS)


def _side(camera: Camera, major: float, pen: Pen) -> int:
    """Return the width of the left ruler that its numbers need [px]."""
    texts = [pen.write(_mark(y), 11, theme.DIM).width for y in _marks(camera, major, 1)]
    return max([*texts, 12]) + LONG + 8


def _vertical(surface: pygame.Surface, camera: Camera, x: float, color: theme.Color) -> None:
    px = round(camera.to_screen((x, 0))[0])
    pygame.draw.line(surface, color, (px, 0), (px, camera.size[1]))


def _horizontal(surface: pygame.Surface, camera: Camera, y: float, color: theme.Color) -> None:
    py = round(camera.to_screen((0, y))[1])
    pygame.draw.line(surface, color, (0, py), (camera.size[0], py))
