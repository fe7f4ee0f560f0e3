"""Draws lines that pygame lacks: thick and smooth ones, dashed ones, and arrows."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import atan2, cos, hypot, pi, sin

import pygame

from sandbox.app.drawing.theme import Color
from sandbox.model.shapes import XY

FAR = 5_000.0  # px, the bound of coordinates beyond which lines are clipped before drawing
EDGE = FAR - 1  # px, to which they are clipped
FARTHEST = 1e30  # px, the bound of coordinates, so that no difference overflows
INNER = 0.45  # the radius of a star's inner corners, relative to the outer one


def are_close(points: Sequence[XY]) -> bool:
    """Whether all points are close enough to be drawn without clipping."""
    return all(-FAR < x < FAR and -FAR < y < FAR for x, y in points)


def distance(a: XY, b: XY, point: XY) -> float:
    """Return the distance of a point from the line segment between two others."""
    along, offset = complex(*b) - complex(*a), complex(*point) - complex(*a)
    share = (offset * along.conjugate()).real / abs(along) ** 2 if along else 0.0
    return abs(offset - min(max(share, 0.0), 1.0) * along)


def star(center: XY, radius: float) -> list[XY]:
    """Return the corners of a five-pointed star, one point up."""
    radii = [radius if i % 2 == 0 else INNER * radius for i in range(10)]
    return [
        (center[0] + r * sin(pi * i / 5), center[1] - r * cos(pi * i / 5))
        for i, r in enumerate(radii)
    ]


def clip(corners: Sequence[XY]) -> list[XY]:
    """Clip a polygon to the part that is close enough to be drawn (Sutherland and Hodgman).

    For a line, given as two corners, the first two corners are the ends of the clipped line.
    """
    remaining = [(_bounded(x), _bounded(y)) for x, y in corners]
    for axis in (0, 1):
        for side in (-1.0, 1.0):
            remaining = _clip(remaining, axis, side)
    return remaining


def _bounded(length: float) -> float:
    return min(max(-FARTHEST, length), FARTHEST)  # in this order NaN is bounded, too


def _clip(corners: list[XY], axis: int, side: float) -> list[XY]:
    """Return the part on one side of an edge; its new corners lie exactly on the edge."""
    remaining: list[XY] = []
    for p, q in zip(corners, [*corners[1:], *corners[:1]], strict=True):
        inside, following = side * p[axis] <= EDGE, side * q[axis] <= EDGE
        if inside:
            remaining.append(p)
        if inside != following:
            share, other = (side * EDGE - p[axis]) / (q[axis] - p[axis]), 1 - axis
            across = p[other] + (q[other] - p[other]) * share
            remaining.append((across, side * EDGE) if axis else (side * EDGE, across))
    return remaining


def visible_part(surface: pygame.Surface, a: XY, b: XY) -> tuple[float, float]:
    """Return the start and end of the part of a line near a surface, as distances from a [px]."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    middle = (surface.width / 2 - a[0]) * ux + (surface.height / 2 - a[1]) * uy
    reach = surface.width + surface.height
    return max(0.0, middle - reach), min(length, middle + reach)


def stroke(surface: pygame.Surface, color: Color, a: XY, b: XY, width: float) -> None:
    """Draw a straight line with smooth sides."""
    (ax, ay), (bx, by) = a, b
    if not (-FAR < ax < FAR and -FAR < ay < FAR and -FAR < bx < FAR and -FAR < by < FAR):
        near_by = clip((a, b))[:2]
        if len(near_by) < 2:
            return
        a, b = near_by
    pygame.draw.aaline(surface, color, a, b, max(round(width), 1))


def cross(surface: pygame.Surface, color: Color, center: XY, arm: float, width: float) -> None:
    """Draw an upright cross, each arm of a length [px]."""
    x, y = center
    stroke(surface, color, (x - arm, y), (x + arm, y), width)
    stroke(surface, color, (x, y - arm), (x, y + arm), width)


def polygon(surface: pygame.Surface, color: tuple[int, ...], corners: Sequence[XY]) -> None:
    """Fill a polygon near the picture; pygame would round its corners to the upper left."""
    pygame.draw.polygon(surface, color, [(round(x), round(y)) for x, y in corners])


def fill(
    surface: pygame.Surface, color: Color, corners: Sequence[XY], rim: Color | None = None
) -> None:
    """Fill a polygon, with smooth sides, or with a rim of another colour."""
    if not are_close(corners):
        corners = clip(corners)
    if len(corners) > 2:
        polygon(surface, color, corners)
        pygame.draw.aalines(surface, rim or color, True, corners)


def path(surface: pygame.Surface, color: Color, points: Sequence[XY], width: float) -> None:
    """Draw a polyline."""
    for a, b in pairwise(points):
        stroke(surface, color, a, b, width)


def dashed(
    surface: pygame.Surface, color: Color, points: Sequence[XY], dash: float = 6, gap: float = 5
) -> None:
    """Draw a dashed polyline, clipped far outside of the surface."""
    if not are_close(points):
        for a, b in pairwise(points):
            dashed(surface, color, clip((a, b))[:2], dash, gap)
        return
    for start, end in dashes(points, dash, gap):
        pygame.draw.aaline(surface, color, start, end)


def dashes(points: Sequence[XY], dash: float, gap: float) -> Iterator[tuple[XY, XY]]:
    """Yield the dashes of a polyline, of some length and distance, as their ends."""
    behind = 0.0  # the phase in dash and gap at the last corner
    period = dash + gap
    for a, b in pairwise(points):
        length = hypot(b[0] - a[0], b[1] - a[1])
        if not length:
            continue
        ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        at = -behind
        while at < length:
            start, end = max(at, 0.0), min(at + dash, length)
            if end > start:
                yield (
                    (a[0] + ux * start, a[1] + uy * start),
                    (a[0] + ux * end, a[1] + uy * end),
                )
            at += period
        behind = (behind + length) % period


def arrow(surface: pygame.Surface, color: Color, start: XY, end: XY, width: float = 2.5) -> None:
    """Draw an arrow; one too short for its head is left out."""
    back = head(surface, color, start, end)
    if back is not None:
        stroke(surface, color, start, back, width)


def head(surface: pygame.Surface, color: Color, start: XY, end: XY) -> XY | None:
    """Draw the head of an arrow, and return the middle of its base; None if there is no room."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    if length < 4 or not are_close((start, end)):
        return None
    size = min(11.0, length * 0.6)
    turn = atan2(end[1] - start[1], end[0] - start[0])
    back = (end[0] - size * cos(turn), end[1] - size * sin(turn))
    x, y = -sin(turn) * size * 0.42, cos(turn) * size * 0.42
    fill(surface, color, [end, (back[0] + x, back[1] + y), (back[0] - x, back[1] - y)])
    return back
