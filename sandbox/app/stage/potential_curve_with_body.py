"""Draws a potential as a landscape: the curve, the body on it, and the line of its energy."""

from collections.abc import Sequence
from math import ceil, floor

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import nice, number, quantity
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY, evaluate
from sandbox.model.view import Landscape
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.stepping.world import World

TICKS = 3
"""The approximate number of labels on the axis of energies."""


class PotentialLandscape:
    """Draws the landscape of a world.

    The curve is that of the formula; the point and the line are measured.
    """

    def __init__(self, landscape: Landscape, world: World) -> None:
        self._body, self._world = landscape.body, world
        self._row = list(world.level.bodies).index(landscape.body)
        names = self._names = (f"{self._body}.potential_energy", f"{self._body}.energy")
        self._meter = Meter(world, names)
        self._x, self._potential = landscape.curve(world.values)
        self._heights = evaluate(landscape.y, world.values)
        self._low = float(self._potential.min())
        self._high = max(float(self._potential.max()), self._energies()[1])
        if self._high <= self._low:
            self._high = self._low + 1.0

    def _energies(self) -> tuple[float, float]:
        """Return the body's potential and total energy [J]."""
        measured = self._meter(self._world.snapshot)
        potential, whole = (float(measured[name]) for name in self._names)
        return potential, whole

    def _height(self, energy: float) -> float:
        """Return the height in the plane at which an energy is drawn [m]."""
        bottom, top = self._heights
        return bottom + (top - bottom) * (energy - self._low) / (self._high - self._low)

    def draw_curve(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        """Draw the static part: the curve, and the axis of energies on its left."""
        points = [
            camera.to_screen((x, self._height(energy)))
            for x, energy in zip(self._x.tolist(), self._potential.tolist(), strict=True)
        ]
        if not lines.are_close(points):
            return
        bottom = camera.to_screen((0.0, self._heights[0]))[1]
        hill = [*points, (points[-1][0], bottom), (points[0][0], bottom)]
        lines.fill(surface, theme.mix(theme.STAGE, theme.POTENTIAL, 0.14), hill)
        lines.path(surface, theme.POTENTIAL, points, 2)
        self._draw_axis(surface, camera, pen)

    def _draw_axis(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        left, right = float(self._x[0]), float(self._x[-1])
        corner = camera.to_screen((left, self._heights[0]))
        top = camera.to_screen((left, self._heights[1]))
        end = camera.to_screen((right, self._heights[0]))
        for tip in ((top[0], top[1] - 14), (end[0] + 14, end[1])):
            lines.arrow(surface, theme.AXIS, corner, tip, 1)
        _write(surface, pen, "U(x) / J", midbottom=(top[0], top[1] - 15))
        _write(surface, pen, "x", midleft=(end[0] + 18, end[1]))
        step = nice((self._high - self._low) / TICKS)
        for i in range(ceil(self._low / step), floor(self._high / step) + 1):
            x, y = camera.to_screen((left, self._height(i * step)))
            lines.stroke(surface, theme.AXIS, (x - 4, y), (x, y), 1)
            _write(surface, pen, number(i * step, 3), midright=(x - 6, y))

    def draw_point(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        """Draw the moving part: the body, its kinetic and total energy, and the turning points."""
        potential, whole = self._energies()
        place = float(self._world.snapshot.position[self._row, 0])
        point, above = camera.path(((place, self._height(potential)), (place, self._height(whole))))
        left, right = camera.path(
            (x, self._height(whole)) for x in (float(self._x[0]), float(self._x[-1]))
        )
        if not lines.are_close((point, above, left, right)):
            return
        lines.dashed(surface, theme.TOTAL, (left, right), 7, 5)
        lines.stroke(surface, theme.KINETIC, point, above, 3)
        for x in turning_points(self._x, self._potential, whole):
            turn = camera.to_screen((x, self._height(whole)))
            pygame.draw.aacircle(surface, theme.TOTAL, turn, 5, 2)
        pygame.draw.aacircle(surface, theme.STAGE, point, 8)
        pygame.draw.aacircle(surface, theme.TEXT, point, 6)
        text = pen.outlined(f"E = {quantity(whole, 'J', 3)}")
        beside = text.get_rect(midleft=(right[0] + 6, right[1]))
        surface.blit(text, beside.clamp(surface.get_rect()))


def turning_points(x: Array, potential: Array, energy: float) -> Sequence[float]:
    """Return the positions at which a potential crosses an energy, interpolated linearly [m]."""
    above = potential - energy
    i = np.nonzero(np.signbit(above[:-1]) != np.signbit(above[1:]))[0]
    share = above[i] / (above[i] - above[i + 1])
    found: list[float] = (x[i] + share * (x[i + 1] - x[i])).tolist()
    return found


def _write(surface: pygame.Surface, pen: Pen, text: str, **place: XY) -> None:
    image = pen.write(text, 12, theme.DIM)
    surface.blit(image, image.get_rect(**place))
