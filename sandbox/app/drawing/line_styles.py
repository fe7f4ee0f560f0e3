"""Markers and dash patterns that distinguish lines without colours."""

from collections.abc import Callable

import pygame

from sandbox.app.drawing import lines
from sandbox.app.drawing.theme import Color
from sandbox.model.shapes import XY

DASHES: tuple[tuple[int, int], ...] = ((6, 5), (2, 4), (12, 4))
"""The dash patterns of companion runs: lengths of dash and gap [px]."""


def dash(lane: int) -> tuple[int, int]:
    """Return the dash pattern of a companion run: lengths of dash and gap [px]."""
    return DASHES[lane % len(DASHES)]


def marker(surface: pygame.Surface, which: int, color: Color, pixel: XY, radius: float = 4) -> None:
    """Draw a marker of some radius [px]; the index is taken modulo the number of markers."""
    _SIGNS[which % len(_SIGNS)](surface, color, pixel, radius)


def _disc(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    pygame.draw.aacircle(surface, color, pixel, r)


def _diamond(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    x, y = pixel
    lines.fill(surface, color, [(x, y - r - 1), (x + r + 1, y), (x, y + r + 1), (x - r - 1, y)])


def _square(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    side = 2 * round(r) - 1
    surface.fill(color, (round(pixel[0]) - side // 2, round(pixel[1]) - side // 2, side, side))


def _triangle(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    x, y = pixel
    lines.fill(surface, color, [(x - r - 1, y + r), (x + r + 1, y + r), (x, y - r - 1)])


def _ring(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    pygame.draw.aacircle(surface, color, pixel, r, 2)


def _cross(surface: pygame.Surface, color: Color, pixel: XY, r: float) -> None:
    x, y = pixel
    for a, b in (((x - r, y - r), (x + r, y + r)), ((x - r, y + r), (x + r, y - r))):
        lines.stroke(surface, color, a, b, 2)


_SIGNS: tuple[Callable[[pygame.Surface, Color, XY, float], None], ...] = (
    _disc, _diamond, _square, _triangle, _ring, _cross,
)  # fmt: skip
SIGNS = len(_SIGNS)
"""The number of different markers."""
