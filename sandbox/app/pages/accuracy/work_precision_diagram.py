"""The diagram of error against cost."""

from collections.abc import Iterator, Mapping, Sequence
from math import ceil, floor, isfinite, log10
from typing import NamedTuple

import pygame

from sandbox.app.drawing import line_styles, lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.shapes import XY
from sandbox.physics.accuracy.error_causes_and_costs import CurrentSetting, WorkPrecisionPoint

LEFT, BELOW, ABOVE, RIGHT = 38, 36, 8, 18  # px, margins of the field
LEAST = 1e-16
"""The smallest error on the axis; smaller ones are drawn there."""


def colors() -> Mapping[str, Color]:
    """Return the colours of the schemes, by their names."""
    return {
        "leapfrog": theme.ACCENT, "fourth-order": theme.PASSED,
        "symplectic-euler": theme.KINETIC, "explicit-euler": theme.FAILED,
        "sixth-order": theme.SPRING, "eighth-order": theme.POTENTIAL,
    }  # fmt: skip


class Axis(NamedTuple):
    """A logarithmic axis between powers of ten, with the pixels of its ends."""

    low: int
    high: int
    start: float
    end: float

    def pixel(self, value: float) -> float:
        """Return the pixel of a value."""
        share = (log10(max(value, LEAST)) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def powers(self, most: int) -> Iterator[int]:
        """Return the exponents to label, at most a given number."""
        every = max(ceil((self.high - self.low + 1) / most), 1)
        return iter(range(self.low, self.high + 1, every))


def axis(values: Sequence[float], start: float, end: float) -> Axis:
    """Return an axis for some values, over at least one power of ten."""
    logs = [log10(max(value, LEAST)) for value in values]
    low, high = floor(min(logs)), ceil(max(logs))
    return Axis(low, max(high, low + 1), start, end)


def draw(
    pen: Pen,
    size: tuple[int, int],
    points: Sequence[WorkPrecisionPoint],
    current: CurrentSetting | None,
) -> pygame.Surface:
    """Draw a line for each scheme, and a ring around the present setting.

    The horizontal axis is the computing time for a second of the scene [ms], the vertical axis the
    largest numerical error.
    """
    surface = pygame.Surface(size)
    surface.fill(theme.STAGE)
    current = current if current and isfinite(current.error) else None
    everything = [*points, *([current] if current else [])]
    if not everything:
        text = pen.write(say("not measured yet"), 12, theme.DIM)
        surface.blit(text, text.get_rect(center=surface.get_rect().center))
        return surface
    across = axis([1e3 * p.cost for p in everything], pen.px(LEFT), size[0] - pen.px(RIGHT))
    up = axis([p.error for p in everything], size[1] - pen.px(BELOW), pen.px(ABOVE))
    _draw_axes(surface, pen, across, up)
    for scheme, color in colors().items():
        line = [_pixel(p, across, up) for p in points if p.scheme == scheme]
        lines.path(surface, theme.faded(color, 0.6), line, 1)
        for pixel in line:
            line_styles.marker(surface, _place(scheme), color, pixel)
    if current:
        pygame.draw.aacircle(surface, theme.TEXT, _pixel(current, across, up), 8, 2)
    return surface


def _pixel(point: WorkPrecisionPoint, across: Axis, up: Axis) -> XY:
    return across.pixel(1e3 * point.cost), up.pixel(point.error)


def _draw_axes(surface: pygame.Surface, pen: Pen, across: Axis, up: Axis) -> None:
    bottom, left = round(up.start), round(across.start)
    for power in up.powers(7):
        y = round(up.pixel(10.0**power))
        pygame.draw.line(surface, theme.GRID_STRONG, (left, y), (across.end, y))
        text = pen.write(formatting.error(10.0**power), 11, theme.DIM)
        surface.blit(text, text.get_rect(midright=(left - 4, y)))
    for power in across.powers(5):
        x = round(across.pixel(10.0**power))
        pygame.draw.line(surface, theme.GRID_STRONG, (x, up.end), (x, bottom))
        text = pen.write(formatting.brief(10.0**power), 11, theme.DIM)
        surface.blit(text, text.get_rect(midtop=(x, bottom + 4)))
    title = pen.write(say("ms of computing for 1 s"), 11, theme.DIM)
    place = title.get_rect(midbottom=((across.start + across.end) / 2, surface.height))
    surface.blit(title, place)


def legend(pen: Pen, width: int, points: Sequence[WorkPrecisionPoint]) -> pygame.Surface:
    """Draw the legend of the schemes, two in a row, with room for all."""
    schemes = list(dict.fromkeys(point.scheme for point in points))
    height = pen.height(12) + 1
    surface = pygame.Surface((width, (len(colors()) + 1) // 2 * height))
    surface.fill(theme.PANEL)
    for i, scheme in enumerate(schemes):
        x, y = (i % 2) * width // 2, (i // 2) * height
        line_styles.marker(surface, _place(scheme), colors()[scheme], (x + 6, y + height // 2))
        surface.blit(pen.write(formatting.scheme(scheme), 12, theme.DIM), (x + 16, y))
    return surface


def _place(scheme: str) -> int:
    """Return the index of the sign of a scheme."""
    return list(colors()).index(scheme)
