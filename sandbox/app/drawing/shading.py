"""Shades shapes as if lit from the upper left; the theme says how strongly."""

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from math import ceil, dist, floor, hypot
from random import Random

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.model.shapes import XY

LIGHT = -0.5, -0.866  # towards the light [px], of unit length

CRESCENT = 0.86
"""The radius of a disc's lit part, relative to the disc's."""
EDGE = 0.55
"""The share of light or shadow at an edge that faces the light or faces away from it."""
DEEP = 220.0  # px, the depth at which solid ground is darkest
DARKEST = 0.62
"""The brightness of solid ground at that depth, relative to that at its top."""
GRAIN, ROUGH = 128, 14
"""The size of the tile of ground [px], and the range of its brightness, from 0 to 255."""
BANDS, DENSE = 8, 190
"""The number of bands in which ground fades out under a line, and its opacity at the line."""
APART = 6.0  # px, the least distance between corners of a line to which ground is drawn
SHARP = 0.5
"""The least sum of 1 and the cosine of a bend at which bands are mitred in full."""


def lighter(color: Color, share: float) -> Color:
    """Return a colour with some share of light, as far as the theme shades."""
    return theme.mix(color, theme.HIGHLIGHT, share * theme.SHADING)


def darker(color: Color, share: float) -> Color:
    """Return a colour with some share of shadow, as far as the theme shades."""
    return theme.mix(color, theme.SHADOW, share * theme.SHADING)


def backdrop(surface: pygame.Surface) -> None:
    """Fill a surface with the colour of the stage, lighter towards the top."""
    strip = pygame.Surface((1, 2))
    strip.set_at((0, 0), theme.mix(theme.STAGE, theme.RAISED, 0.5 * theme.SHADING))
    strip.set_at((0, 1), theme.STAGE)
    pygame.transform.smoothscale(strip, surface.size, surface)


def disc(surface: pygame.Surface, color: Color, center: XY, radius: float) -> None:
    """Fill a disc, with a darker crescent on the side away from the light."""
    if not theme.SHADING or radius < 5:
        pygame.draw.aacircle(surface, color, center, radius)
        return
    pygame.draw.aacircle(surface, darker(color, 0.25), center, radius)
    shift = (1 - CRESCENT) * radius * 0.8
    lit = center[0] + LIGHT[0] * shift, center[1] + LIGHT[1] * shift
    pygame.draw.aacircle(surface, color, lit, CRESCENT * radius)


def bevel(surface: pygame.Surface, rim: Color, corners: Sequence[XY], width: int) -> None:
    """Draw the edges of a polygon near the picture, lighter where they face the light."""
    edges = list(pairwise([*corners, corners[0]]))
    outward = 1 if sum(ax * by - bx * ay for (ax, ay), (bx, by) in edges) > 0 else -1
    for (ax, ay), (bx, by) in edges:
        facing = outward * ((by - ay) * LIGHT[0] - (bx - ax) * LIGHT[1])
        # in hundredths, so that the colours of a frame have been mixed before
        share = round(EDGE * facing / (hypot(bx - ax, by - ay) or 1.0), 2)
        shade = lighter(rim, share) if share > 0 else darker(rim, -share)
        pygame.draw.aaline(surface, shade, (ax, ay), (bx, by), width)


def solid(surface: pygame.Surface, color: Color, corners: Sequence[XY]) -> None:
    """Fill a polygon of solid ground: grainy, and darker with depth."""
    corners = corners if lines.are_close(corners) else lines.clip(corners)
    if len(corners) < 3:
        return
    if not theme.SHADING:
        lines.fill(surface, color, corners)
        return
    area, corner = _covering(surface, corners)
    layer = pygame.Surface(area.size, pygame.SRCALPHA)
    shape = [(x - area.left, y - area.top) for x, y in corners]
    lines.polygon(layer, lighter(color, 0.06), shape)
    _shade(layer, corner[0] - area.left, corner[1] - area.top)
    surface.blit(layer, area)
    pygame.draw.aalines(surface, color, True, corners)


def _covering(surface: pygame.Surface, points: Sequence[XY]) -> tuple[pygame.Rect, tuple[int, int]]:
    """Return the visible part of a rectangle around points, and its upper left corner [px]."""
    (left, *_, right), (top, *_, bottom) = map(sorted, zip(*points, strict=True))
    whole = pygame.Rect(floor(left), floor(top), ceil(right - left) + 2, ceil(bottom - top) + 2)
    return whole.clip(surface.get_rect()), whole.topleft


def _shade(layer: pygame.Surface, left: int, top: int) -> None:
    """Multiply a layer by the brightness of ground whose upper left corner is at a pixel."""
    flags = pygame.BLEND_RGB_MULT
    strip = _depths()
    for x in range(left % GRAIN - GRAIN, layer.width, GRAIN):
        for y in range(top % GRAIN - GRAIN, layer.height, GRAIN):
            layer.blit(_grain(), (x, y), special_flags=flags)
    deep = pygame.transform.scale(strip, (layer.width, strip.height))
    layer.blit(deep, (0, top), special_flags=flags)
    rest = pygame.Rect(0, top + strip.height, layer.width, layer.height).clip(layer.get_rect())
    layer.fill(strip.get_at((0, strip.height - 1)), rest, special_flags=flags)


@lru_cache(maxsize=1)
def _depths() -> pygame.Surface:
    """Return a column of the brightness at each depth."""
    bright = np.linspace(255, 255 * DARKEST, round(DEEP))
    return pygame.surfarray.make_surface(np.tile(bright[None, :, None], (1, 1, 3)))


@lru_cache(maxsize=1)
def _grain() -> pygame.Surface:
    """Return a tile of grainy ground, the same in every run."""
    side = GRAIN // 2
    bright = np.array(Random(1).choices(range(255 - ROUGH, 256), k=side * side))
    coarse = pygame.surfarray.make_surface(np.repeat(bright.reshape(side, side, 1), 3, axis=2))
    return pygame.transform.scale(coarse, (GRAIN, GRAIN))


def bank(
    surface: pygame.Surface, color: Color, corners: Sequence[XY], side: int, depth: float
) -> None:
    """Draw ground that fades out with its depth on one side of a line [px].

    The side is 1 for that of the normal (uy, −ux) to the line, −1 for the other.
    """
    if not theme.SHADING:
        return
    if not lines.are_close(corners):
        for piece in pairwise(corners):
            if len(seen := lines.clip(piece)) > 1:
                bank(surface, color, seen[:2], side, depth)
        return
    corners = _thinned(corners)
    across = _mitres(corners)
    rims = [
        [(x + nx * reach, y + ny * reach) for (x, y), (nx, ny) in zip(corners, across, strict=True)]
        for reach in (side * depth * band / BANDS for band in range(BANDS + 1))
    ]
    area, _ = _covering(surface, [*corners, *rims[-1]])
    layer = pygame.Surface(area.size, pygame.SRCALPHA)
    for band in range(BANDS, 0, -1):
        shade = (*color, round(DENSE * (BANDS + 1 - band) / BANDS))
        for (a, b), (c, d) in zip(pairwise(corners), pairwise(rims[band]), strict=True):
            quad = [(x - area.left, y - area.top) for x, y in (a, b, d, c)]
            lines.polygon(layer, shade, quad if lines.are_close(quad) else lines.clip(quad))
    surface.blit(layer, area)


def _thinned(corners: Sequence[XY]) -> Sequence[XY]:
    """Return the corners of a line without those that are close together."""
    kept = [corners[0]]
    for corner in corners[1:-1]:
        if dist(corner, kept[-1]) > APART < dist(corner, corners[-1]):
            kept.append(corner)
    return [*kept, corners[-1]]


def _mitres(corners: Sequence[XY]) -> Sequence[XY]:
    """Return, for each corner of a line, the way to a parallel line at unit distance."""
    normals = [
        ((by - ay) / hypot(bx - ax, by - ay), (ax - bx) / hypot(bx - ax, by - ay))
        for (ax, ay), (bx, by) in pairwise(corners)
    ]
    directions = []
    for (ax, ay), (bx, by) in pairwise([normals[0], *normals, normals[-1]]):
        size = max(1 + ax * bx + ay * by, SHARP)
        directions.append(((ax + bx) / size, (ay + by) / size))
    return directions
