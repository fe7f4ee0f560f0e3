"""A protractor, which measures the angle between a tape and another line from its end."""

from dataclasses import dataclass
from math import atan2, degrees, pi
from typing import TYPE_CHECKING

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.model.shapes import XY

if TYPE_CHECKING:
    from sandbox.app.measuring.tape import Tape

RADIUS = 26  # px, of the arc


@dataclass(frozen=True, slots=True)
class Protractor:
    """An angle between two legs: the points at their ends, and the common corner [m]."""

    first: XY
    corner: XY
    second: XY

    @classmethod
    def on(cls, before: "Tape | Protractor", second: XY) -> "Protractor":
        """Return the protractor that a second leg makes.

        On a tape, its corner is the tape's end. On a protractor, it is the same one with the second
        leg moved.
        """
        if isinstance(before, Protractor):
            return cls(before.first, before.corner, second)
        return cls(before.start, before.end, second)

    @property
    def angle(self) -> float:
        """The angle at the corner, from 0 to 180 [deg]."""
        (ax, ay), (bx, by) = self._legs
        return degrees(abs(atan2(ax * by - ay * bx, ax * bx + ay * by)))

    @property
    def text(self) -> str:
        """The angle as text."""
        return f"{number(self.angle, 4)}°"

    @property
    def _legs(self) -> tuple[XY, XY]:
        x, y = self.corner
        (ax, ay), (bx, by) = self.first, self.second
        return (ax - x, ay - y), (bx - x, by - y)

    def draw(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        """Draw both legs and the arc between them, with the angle beside the corner."""
        corner = camera.to_screen(self.corner)
        for end in (self.first, self.second):
            lines.stroke(surface, theme.NOTICE, corner, camera.to_screen(end), 2)
        (ax, ay), (bx, by) = self._legs
        start, stop = atan2(ay, ax), atan2(by, bx)
        turn = (stop - start + pi) % (2 * pi) - pi
        box = pygame.Rect(0, 0, 2 * RADIUS, 2 * RADIUS)
        box.center = round(corner[0]), round(corner[1])
        low, high = sorted((start, start + turn))
        pygame.draw.arc(surface, theme.NOTICE, box, low, high, 2)
        text = pen.outlined(self.text, 14)
        place = text.get_rect(midbottom=(corner[0], corner[1] - RADIUS - 4))
        surface.blit(text, place.clamp(surface.get_rect()))
