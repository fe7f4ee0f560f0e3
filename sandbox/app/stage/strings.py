"""Draws strings over pegs, with a small wheel at each.

In a wide bend the wheel is inside it, so that the string stays where it is. In a sharp one that
would be far from the peg, such as a block that hangs in a loop; there the wheel is on the peg, and
the string runs around it.
"""

from cmath import phase
from collections.abc import Sequence
from itertools import pairwise
from math import acos, atan2, copysign, cos, dist, hypot, pi, sin, tan, tau
from typing import NamedTuple

import pygame

from sandbox.app.drawing import lines, shading, theme
from sandbox.model.shapes import XY

LONG = 40.0  # px, the distance between the ends of a string from which its twist is drawn
TWIST = 0.4
"""The share of shadow between the strands of a string."""
SPOKES = 3
WHEEL = 13.0  # px, the largest radius
SHARP = 0.5
"""Half the angle between the strands below which a bend is sharp."""
ROUND = 16
"""The chords of the arc around a wheel on a peg."""
SHARE = 0.24
"""The largest distance from a peg to the tangent points, as a fraction of the shorter side: two
neighbours fit."""


class Bend(NamedTuple):
    """The bend of a string around a peg: the wheel, and the points of the arc [px]."""

    center: XY
    radius: float
    arc: list[XY]


def draw_string(surface: pygame.Surface, corners: Sequence[XY], slack: bool) -> None:
    """Draw a string through its ends and pegs [px]; a slack one is dashed."""
    bends = [_bend(*corners[i - 1 : i + 2]) for i in range(1, len(corners) - 1)]
    path = [corners[0]]
    for peg, bend in zip(corners[1:-1], bends, strict=True):
        if bend:
            before = sum(dist(a, b) for a, b in pairwise([*path, bend.arc[0]]))
            _wheel(surface, bend, before)
        path += bend.arc if bend else [peg]
    path.append(corners[-1])
    draw_line(surface, path, slack)
    mark_ends(surface, corners)


def draw_line(surface: pygame.Surface, path: Sequence[XY], slack: bool) -> None:
    """Draw a string along a path [px]: dashed if slack, else twisted, which shows how it moves."""
    if slack:
        lines.dashed(surface, theme.STRING, path, 4, 4)
        return
    lines.path(surface, theme.STRING, path, 2)
    if theme.SHADING and dist(path[0], path[-1]) > LONG:
        lines.dashed(surface, shading.darker(theme.STRING, TWIST), path, 4, 8)


def mark_ends(surface: pygame.Surface, corners: Sequence[XY]) -> None:
    """Mark the ends of a string."""
    for x, y in (corners[0], corners[-1]):
        pygame.draw.aacircle(surface, theme.STAGE, (x, y), 4)
        pygame.draw.aacircle(surface, theme.STRING, (x, y), 2.5)


def _wheel(surface: pygame.Surface, bend: Bend, before: float) -> None:
    """Draw a wheel, turned as far as a length of string before it [px] tells."""
    pygame.draw.aacircle(surface, theme.RAISED, bend.center, bend.radius)
    (ax, ay), (bx, by), (x, y) = bend.arc[0], bend.arc[1], bend.center
    sense = copysign(1.0, (ax - x) * (by - y) - (ay - y) * (bx - x))
    for spoke in range(SPOKES):
        turn = tau * spoke / SPOKES - sense * before / bend.radius
        rim = x + bend.radius * cos(turn), y + bend.radius * sin(turn)
        lines.stroke(surface, theme.AXIS, (x, y), rim, 2)
    pygame.draw.aacircle(surface, theme.SURFACE_EDGE, bend.center, bend.radius, 2)
    pygame.draw.aacircle(surface, theme.SURFACE_EDGE, bend.center, 2.5)


def _bend(before: XY, peg: XY, after: XY) -> Bend | None:
    """Return the bend of a string at a peg; None if the string is straight or folded there."""
    to_before, to_after = _unit(peg, before), _unit(peg, after)
    if to_before is None or to_after is None:
        return None
    half = acos(max(-1.0, min(1.0, to_before[0] * to_after[0] + to_before[1] * to_after[1]))) / 2
    if half < SHARP:
        return _around(peg, before, after)
    if half > pi / 2 - 0.02:
        return None
    shorter = min(hypot(peg[0] - p[0], peg[1] - p[1]) for p in (before, after))
    radius = min(WHEEL, SHARE * shorter * tan(half))
    away = radius / sin(half)
    middle = to_before[0] + to_after[0], to_before[1] + to_after[1]
    size = hypot(*middle)
    center = peg[0] + middle[0] / size * away, peg[1] + middle[1] / size * away
    return Bend(center, radius, _arc(center, radius, peg, to_before, to_after, radius / tan(half)))


def _around(peg: XY, before: XY, after: XY) -> Bend | None:
    """Return the bend around a wheel on a peg; None if an end is too near for one."""
    directions = [complex(x - peg[0], y - peg[1]) for x, y in (before, after)]
    radius = min(WHEEL, SHARE * min(map(abs, directions)))
    if radius < 1:
        return None
    side = (
        -1 if (directions[0].conjugate() * directions[1]).imag < 0 else 1
    )  # on which the second strand is
    first, last = (
        phase(direction) - turn * side * acos(radius / abs(direction))
        for direction, turn in zip(directions, (1, -1), strict=True)
    )
    turn = -side * ((-side * (last - first)) % tau)
    steps = [first + turn * i / ROUND for i in range(ROUND + 1)]
    arc = [(peg[0] + radius * cos(a), peg[1] + radius * sin(a)) for a in steps]
    return Bend(peg, radius, arc)


def _arc(center: XY, radius: float, peg: XY, one: XY, other: XY, reach: float) -> list[XY]:
    """Return the points of the arc between the two tangent points, on the side of the peg [px]."""
    first = atan2(peg[1] + one[1] * reach - center[1], peg[0] + one[0] * reach - center[0])
    last = atan2(peg[1] + other[1] * reach - center[1], peg[0] + other[0] * reach - center[0])
    turn = (last - first + pi) % (2 * pi) - pi
    steps = [first + turn * i / 8 for i in range(9)]
    return [(center[0] + radius * cos(a), center[1] + radius * sin(a)) for a in steps]


def _unit(a: XY, b: XY) -> XY | None:
    size = hypot(b[0] - a[0], b[1] - a[1])
    return ((b[0] - a[0]) / size, (b[1] - a[1]) / size) if size else None
