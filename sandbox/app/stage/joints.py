"""Draws joints; each kind has its own look."""

from cmath import phase
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import acos, atan2, cos, dist, hypot, pi, sin, tau

import pygame

from sandbox.app.drawing import lines, shading, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.stage import strings
from sandbox.model.expressions import Values
from sandbox.model.joints import (
    AngleStop,
    Gear,
    Held,
    Joint,
    Motor,
    Pivot,
    Pulley,
    Rack,
    Rail,
    Rod,
    Rope,
    Slot,
    Spring,
    Stop,
    Weld,
    Winding,
    Wire,
    body_of,
)
from sandbox.model.shapes import XY, evaluate

COILS = 9
COIL = 7.0  # px, the amplitude of a coil
STRAIGHT = 10.0  # px, the straight wire at each end of a coil
TEETH = 10
COG = 9.0  # px, the radius of a toothed wheel
WALL = 14.0  # px, the length of a stop to either side
RAY = 30.0  # px, the length of an angle stop from its pin
BUFFER = 4.5  # px, the amplitude of an elastic stop's coil, and the distance between its turns
HOOK = 7.0  # px, the radius of an open hook
GAPE = 0.9  # rad, half the opening of a hook
LONG = 40.0  # px, the length from which a rod shines
GLOSS, BEHIND = 0.45, 0.4
"""The share of white along a rod, and of black in the turns of a spring that lie behind."""
SAG = 0.12
"""The sag of a slack rope, relative to the distance between its ends on the screen."""


def draw_joint(
    surface: pygame.Surface, camera: Camera, joint: Joint, path: Sequence[XY], slack: bool
) -> None:
    """Draw a joint through points of the plane [m]; a slack rope is dashed."""
    corners = camera.path(path)
    if isinstance(joint, Rail) or lines.are_close(
        corners
    ):  # a rail is long, and clipped as it is drawn
        LOOKS.get(type(joint), _plain)(surface, corners, slack)
        if isinstance(joint, Stop | AngleStop) and joint.restitution is not None:
            for place, direction in _faces(joint, corners):
                lines.path(surface, theme.SPRING, _buffer(place, direction), 2)


def draw_crowd(surface: pygame.Surface, camera: Camera, path: Sequence[XY]) -> None:
    """Draw one of many joints through points of the plane [m]: a line, or a dot, without pins."""
    corners = camera.path(path)
    if not lines.are_close(corners):
        return
    if dist(corners[0], corners[-1]) > 1:
        lines.path(surface, theme.SURFACE_EDGE, corners, 2)
    else:
        surface.fill(theme.SURFACE_EDGE, (corners[0][0] - 1, corners[0][1] - 1, 3, 3))


def draw_open(surface: pygame.Surface, camera: Camera, path: Sequence[XY]) -> None:
    """Draw a joint that has not latched yet: a hook at each end, open towards the other."""
    begin, *_, end = camera.path(path)
    if not lines.are_close((begin, end)):
        return
    for (x, y), other in ((begin, end), (end, begin)):
        ahead = atan2(other[1] - y, other[0] - x)
        turns = [ahead + GAPE + (tau - 2 * GAPE) * i / 16 for i in range(17)]
        hook = [(x + HOOK * cos(turn), y + HOOK * sin(turn)) for turn in turns]
        lines.path(surface, theme.STRING, hook, 3)


def _plain(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw a joint without a look of its own: dots at its ends, and dashes between them."""
    lines.dashed(surface, theme.SURFACE_EDGE, corners, 5, 4)
    _pins(surface, corners)


def _rod(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    lines.path(surface, theme.SURFACE_EDGE, corners, 6)
    if dist(corners[0], corners[-1]) > LONG:
        lines.path(surface, shading.lighter(theme.SURFACE_EDGE, GLOSS), corners, 2)
    _pins(surface, corners)


def _track(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    lines.path(surface, theme.SURFACE_EDGE, corners, 3)


def _spring(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    coil = _coil(corners[0], corners[1])
    behind = shading.darker(theme.SPRING, BEHIND)
    turns = list(pairwise(coil))
    for a, b in turns[1::2]:
        lines.stroke(surface, behind, a, b, 2)
    for a, b in turns[::2]:
        lines.stroke(surface, theme.SPRING, a, b, 3)
    _pins(surface, corners)


def _rope(surface: pygame.Surface, corners: Sequence[XY], slack: bool) -> None:
    a, b = corners
    strings.draw_line(surface, _sagging(a, b) if slack else (a, b), slack)
    strings.mark_ends(surface, (a, b))


def _sagging(a: XY, b: XY) -> list[XY]:
    """Return the points of a parabola that sags between two points [px]."""
    depth = SAG * max(hypot(b[0] - a[0], b[1] - a[1]), 60.0)
    shares = [i / 16 for i in range(17)]
    return [
        (a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s + 4 * depth * s * (1 - s))
        for s in shares
    ]


def _coil(a: XY, b: XY) -> list[XY]:
    """Return the points of a zigzag between two points, with straight ends [px]."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    if length <= 2 * STRAIGHT:
        return [a, b]
    ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    turn = (length - 2 * STRAIGHT) / (2 * COILS)
    along = [0.0, STRAIGHT, *(STRAIGHT + turn * (i + 0.5) for i in range(2 * COILS))]
    along += [length - STRAIGHT, length]
    aside = [0.0, 0.0, *(COIL if i % 2 else -COIL for i in range(2 * COILS)), 0.0, 0.0]
    return [
        (a[0] + ux * s - uy * w, a[1] + uy * s + ux * w) for s, w in zip(along, aside, strict=True)
    ]


def _pins(surface: pygame.Surface, places: Sequence[XY]) -> None:
    for place in places:
        pygame.draw.aacircle(surface, theme.STAGE, place, 5)
        pygame.draw.aacircle(surface, theme.SURFACE_EDGE, place, 3)


def _pivot(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw a pin: a ring with a cross."""
    place = corners[0]
    pygame.draw.aacircle(surface, theme.STAGE, place, 7)
    pygame.draw.aacircle(surface, theme.STRING, place, 7, 2)
    for angle in (pi / 4, 3 * pi / 4):
        x, y = 5 * cos(angle), 5 * sin(angle)
        ends = (place[0] - x, place[1] - y), (place[0] + x, place[1] + y)
        lines.stroke(surface, theme.STRING, *ends, 1)


def _motor(surface: pygame.Surface, corners: Sequence[XY], slack: bool) -> None:
    """Draw a motor: a pin in a bold ring."""
    pygame.draw.aacircle(surface, theme.SURFACE_EDGE, corners[0], 12, 3)
    _pivot(surface, corners, slack)


def _cog(surface: pygame.Surface, center: XY) -> None:
    """Draw a small toothed wheel."""
    for i in range(TEETH):
        angle = tau * i / TEETH
        begin, end = (
            (center[0] + r * cos(angle), center[1] + r * sin(angle)) for r in (COG, COG + 4.0)
        )
        lines.stroke(surface, theme.SURFACE_EDGE, begin, end, 3)
    pygame.draw.aacircle(surface, theme.SURFACE_EDGE, center, COG, 2)


def _gear(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw a toothed wheel in each of two bodies, and dashes between them."""
    lines.dashed(surface, theme.SURFACE_EDGE, corners[:2], 5, 4)
    for corner in corners[:2]:
        _cog(surface, corner)


def _rack(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw a toothed wheel, and dashes to the bar that it moves."""
    lines.dashed(surface, theme.SURFACE_EDGE, corners[:2], 5, 4)
    _cog(surface, corners[1])


def _stop(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw two walls across the line between them."""
    (ax, ay), (bx, by) = corners[:2]
    length = hypot(bx - ax, by - ay)
    if not length:
        return
    across = -(by - ay) / length * WALL, (bx - ax) / length * WALL
    lines.dashed(surface, theme.SURFACE_EDGE, corners[:2], 3, 6)
    for x, y in corners[:2]:
        ends = (x - across[0], y - across[1]), (x + across[0], y + across[1])
        lines.stroke(surface, theme.STRING, *ends, 4)


def _angle_stop(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    """Draw two rays from a pin, at the limits of the angle."""
    center, *limits = corners
    for x, y in limits:
        length = hypot(x - center[0], y - center[1])
        if length:
            ux, uy = (x - center[0]) / length, (y - center[1]) / length
            begin, end = ((center[0] + r * ux, center[1] + r * uy) for r in (9.0, RAY))
            lines.stroke(surface, theme.STRING, begin, end, 3)


def _faces(joint: Stop | AngleStop, corners: Sequence[XY]) -> Iterator[tuple[XY, XY]]:
    """Yield the position of each stop [px], and the unit vector of motion into it."""
    if isinstance(joint, Stop):
        for (x, y), (ox, oy) in (corners[:2], corners[1::-1]):
            if length := hypot(ox - x, oy - y):
                yield (x, y), ((x - ox) / length, (y - oy) / length)
        return
    (cx, cy), *ends = corners
    for (x, y), sense in zip(ends, (1, -1), strict=True):  # counter-clockwise from the lower
        if length := hypot(x - cx, y - cy):
            ux, uy = (x - cx) / length, (y - cy) / length
            yield (cx + RAY * ux, cy + RAY * uy), (-sense * uy, sense * ux)


def _buffer(place: XY, direction: XY) -> list[XY]:
    """Return the points of the short coil behind an elastic stop [px]."""
    (x, y), (ux, uy) = place, direction
    aside = (0.0, BUFFER, -BUFFER, BUFFER, -BUFFER, 0.0)
    return [
        (x + ux * BUFFER * i - uy * w, y + uy * BUFFER * i + ux * w) for i, w in enumerate(aside)
    ]


def stop_limits(joint: Stop, path: Sequence[XY], values: Values) -> list[XY]:
    """Return the ends of a stop's range [m], given the points of the joint."""
    direction = complex(*evaluate(joint.direction, values))
    start = complex(*path[1])
    places = [start + direction / abs(direction) * limit(values) for limit in joint.range]
    return [(place.real, place.imag) for place in places]


def stop_rays(joint: AngleStop, center: XY, angle: float, values: Values) -> list[XY]:
    """Return a pin, and points in the directions of the stops around it [m].

    The angle is that of the reference of the stops [rad].
    """
    second = joint.ends[1]
    at = complex(*evaluate(second.at, values)) if isinstance(second, Held) else 0j
    angle += phase(-at) if at else 0.0
    found = [angle + limit(values) for limit in joint.range]
    return [center, *((center[0] + cos(a), center[1] + sin(a)) for a in found)]


def drawn_path(
    joint: Joint, path: list[XY], values: Values, angle_of: Callable[[str], float]
) -> list[XY]:
    """Return the points through which a joint is drawn, given those that it runs through [m].

    `angle_of` returns the angle of a body [rad].
    """
    match joint:
        case Winding():
            return wound_path(path[0], path[1], joint.radius(values), joint)
        case Stop():
            return stop_limits(joint, path, values)
        case AngleStop():
            base = body_of(joint.ends[0])
            return stop_rays(joint, path[1], angle_of(base) if base else 0.0, values)
    return path


def _weld(surface: pygame.Surface, corners: Sequence[XY], _: bool) -> None:
    lines.path(surface, theme.SURFACE_EDGE, corners, 6)


def _winding(surface: pygame.Surface, corners: Sequence[XY], slack: bool) -> None:
    """Draw a string from its end to a wheel, and around the wheel."""
    lines.path(surface, theme.STRING, corners[1:], 2)
    strings.draw_line(surface, corners[1::-1], slack)
    strings.mark_ends(surface, (corners[0], corners[0]))


def wound_path(end: XY, center: XY, radius: float, winding: Winding) -> list[XY]:
    """Return the points of a string from its end to a wheel, and around the wheel [m]."""
    x, y = end[0] - center[0], end[1] - center[1]
    side = acos(min(radius / (hypot(x, y) or radius), 1.0))
    leaves = atan2(y, x) + (side if winding.unwinds == "clockwise" else -side)
    angles = [leaves + tau * i / 48 for i in range(49)]
    return [end, *((center[0] + radius * cos(a), center[1] + radius * sin(a)) for a in angles)]


Look = Callable[[pygame.Surface, Sequence[XY], bool], None]
"""A function that draws a joint through points [px]; the last argument is whether it is slack."""

LOOKS: Mapping[type, Look] = {
    Pulley: strings.draw_string,
    Rope: _rope,
    Rail: _track,
    Slot: _track,
    Rod: _rod,
    Spring: _spring,
    Pivot: _pivot,
    Wire: _track,
    Motor: _motor,
    Weld: _weld,
    Winding: _winding,
    Gear: _gear,
    Rack: _rack,
    Stop: _stop,
    AngleStop: _angle_stop,
}
"""The look of each kind; any other kind is drawn by `_plain`."""

IN_FRONT = (Pivot, Motor, Winding, Gear, Rack, AngleStop)
"""The kinds that are drawn over bodies, since they go through or around these."""
