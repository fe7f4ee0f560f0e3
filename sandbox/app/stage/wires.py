"""Draws the wires on which beads slide: they never move, so they are a part of the base."""

from collections.abc import Sequence
from math import dist

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.model.joints import Wire
from sandbox.model.shapes import XY
from sandbox.model.wire_points import along
from sandbox.physics.stepping.world import World

POINTS = 1000
"""The number of points of a wire: with 200, a spiral was seen to have corners."""
STRAIGHT, APART = 4.0, 12.0  # px, the least distances of drawn points, and of those labels avoid


def holding_wires(world: World) -> Sequence[str]:
    """Return the wires that hold their beads at present."""
    named, t = world.level.joints.items(), float(world.snapshot.t)
    wires = (name for name, joint in named if isinstance(joint, Wire))
    return [name for name in wires if world.scene.joints.holds(name, t)]


def draw_wires(surface: pygame.Surface, camera: Camera, world: World) -> list[Sequence[XY]]:
    """Draw the wires, and return points along each that are enough to keep labels off it [px]."""
    sparse = []
    for name in holding_wires(world):
        wire = world.level.joints[name]
        assert isinstance(wire, Wire)
        points = along(wire, world.values, POINTS)
        pixels = camera.path([(p.real, p.imag) for p in points.tolist()])
        lines.path(surface, theme.SURFACE_EDGE, _spaced(pixels, STRAIGHT), 3)
        sparse.append(_spaced(pixels, APART))
    return sparse


def _spaced(points: Sequence[XY], apart: float) -> Sequence[XY]:
    """Return the first and the last point, and points between them at least so far apart [px]."""
    spaced = [points[0]]
    for point in points[1:-1]:
        if dist(point, spaced[-1]) >= apart:
            spaced.append(point)
    return [*spaced, points[-1]]
