"""A tape measure between two points of the plane."""

from dataclasses import dataclass
from math import atan2, degrees, hypot

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.model.shapes import XY


@dataclass(frozen=True, slots=True)
class Tape:
    """A distance between two points [m]."""

    start: XY
    end: XY

    @property
    def text(self) -> str:
        """The distance, its two components, and the angle as text."""
        dx, dy = self.end[0] - self.start[0], self.end[1] - self.start[1]
        angle = degrees(atan2(dy, dx))
        parts = f"Δx {number(dx, 4)} m   Δy {number(dy, 4)} m   {number(angle, 4)}°"
        return f"{number(hypot(dx, dy), 4)} m    {parts}"

    def draw(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        """Draw the tape, with its text beside the end."""
        start, end = camera.to_screen(self.start), camera.to_screen(self.end)
        lines.stroke(surface, theme.NOTICE, start, end, 2)
        for point in (start, end):
            pygame.draw.aacircle(surface, theme.NOTICE, point, 4, 2)
        text = pen.outlined(self.text, 14)
        place = text.get_rect(midbottom=(end[0], end[1] - 10))
        surface.blit(text, place.clamp(surface.get_rect()))
