"""The moving marks on a belt, and the flame of a rocket."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import ceil, cos, floor, hypot, sin

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.stage.body_outlines import Outline
from sandbox.app.words.formatting import nice
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World

SPACING = 60.0  # px, the approximate distance between a belt's marks
MARK = 7.0  # px, the length of a mark
LENGTH = 0.4  # of a flame, relative to the body's length
FLICKER = 45.0  # rad/s


def draw_belts(
    surface: pygame.Surface, camera: Camera, world: World, outlines: Mapping[str, Outline]
) -> None:
    """Draw marks that move with the surfaces of belts."""
    t = float(world.snapshot.t)
    for belt in world.level.effects.belt or ():
        outline = outlines[belt.body]
        if not outline.closed:
            continue
        vx, vy = evaluate(belt.velocity, world.values)
        placed = outline.placed(*_state(world, outline))
        middle = _middle(camera.path(placed))
        own = [*outline.points, outline.points[0]]
        for (p, q), (a, b) in zip(pairwise(own), pairwise([*placed, placed[0]]), strict=True):
            length = hypot(q[0] - p[0], q[1] - p[1])
            speed = (vx * (q[0] - p[0]) + vy * (q[1] - p[1])) / length if length else 0.0
            if speed:
                _draw_marks(surface, camera, (a, b), speed * t, middle)


def _draw_marks(
    surface: pygame.Surface, camera: Camera, side: tuple[XY, XY], run: float, middle: XY
) -> None:
    """Draw the marks on the visible part of a belt's side that has run some distance [m]."""
    a, b = camera.path(side)
    length, run = hypot(b[0] - a[0], b[1] - a[1]), run * camera.scale
    spacing = nice(SPACING / camera.scale) * camera.scale
    first, last = lines.visible_part(surface, a, b)
    for i in range(ceil((first - run) / spacing), floor((last - run) / spacing) + 1):
        share = (i * spacing + run) / length
        at = a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share
        _mark(surface, at, (a, b), middle)


def _mark(surface: pygame.Surface, at: XY, side: Sequence[XY], middle: XY) -> None:
    (ax, ay), (bx, by) = side
    length = hypot(bx - ax, by - ay)
    nx, ny = (ay - by) / length * MARK, (bx - ax) / length * MARK
    if (middle[0] - at[0]) * nx + (middle[1] - at[1]) * ny < 0:
        nx, ny = -nx, -ny
    lines.stroke(surface, theme.NOTICE, at, (at[0] + nx, at[1] + ny), 2)


def draw_flames(
    surface: pygame.Surface, camera: Camera, world: World, outlines: Mapping[str, Outline]
) -> None:
    """Draw the flames of rockets, as long as there is propellant."""
    t = float(world.snapshot.t)
    for thrust in world.level.effects.thrust or ():
        if t >= thrust.propellant(world.values) / thrust.rate(world.values):
            continue
        outline = outlines[thrust.body]
        x, y = evaluate(thrust.exhaust, world.values)
        speed = hypot(x, y)
        if not speed:
            continue
        (px, py), angle = _state(world, outline)
        c, s = cos(angle), sin(angle)
        ux, uy = (c * x - s * y) / speed, (s * x + c * y) / speed
        along, across = _extents(outline.placed((0.0, 0.0), angle), (ux, uy))
        size = LENGTH * (along[1] - along[0]) * (1 + 0.12 * sin(FLICKER * t))
        center = sum(across) / 2
        for color, share in ((theme.FLAME, 1.0), (theme.FLAME_CORE, 0.55)):
            half = 0.4 * (across[1] - across[0]) * share
            rear, tip = along[1], along[1] + size * share
            local = [(rear, center - half), (tip, center), (rear, center + half)]
            corners = [(px + ux * a - uy * b, py + uy * a + ux * b) for a, b in local]
            lines.fill(surface, color, camera.path(corners))


def _extents(points: Sequence[XY], direction: XY) -> tuple[XY, XY]:
    """Return the range of points along a direction, and across it at the far end [m]."""
    along = [x * direction[0] + y * direction[1] for x, y in points]
    last = max(along) - 0.05 * (max(along) - min(along))
    across = [
        y * direction[0] - x * direction[1]
        for (x, y), a in zip(points, along, strict=True)
        if a >= last
    ]
    return (min(along), max(along)), (min(across), max(across))


def _middle(corners: Sequence[XY]) -> XY:
    return sum(x for x, _ in corners) / len(corners), sum(y for _, y in corners) / len(corners)


def _state(world: World, outline: Outline) -> tuple[XY, float]:
    x, y = world.snapshot.position[outline.row].tolist()
    return (x, y), float(world.snapshot.angle[outline.row])
