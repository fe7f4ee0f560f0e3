"""The graph of a run's energies over time."""

from collections.abc import Sequence

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY

DASH = 9, 3
"""The dash pattern of the potential energy: lengths of dash and gap [px]."""

ROOM = 0.06
"""The free space above and below the lines, as a share of the height."""

ROUNDING = 1e-12
"""Smaller differences are rounding: such a line is drawn level [J]."""


def energies(size: tuple[int, int], points: Array, duration: float) -> pygame.Surface:
    """Draw energies over at least a duration [s].

    The points are (k, 4), k > 0: time [s], then kinetic, potential and total energy [J].
    """
    graph = pygame.Surface(size)
    graph.fill(theme.STAGE)
    values = points[:, 1:]
    low, high = min(float(values.min()), 0.0), max(float(values.max()), 0.0)
    spread = high - low if high - low > ROUNDING else 1.0
    width, height = size[0] - 1, size[1] - 1
    x = width * points[:, 0] / max(duration, float(points[-1, 0]))
    y = height * (1 - ROOM - (1 - 2 * ROOM) * (values - low) / spread)
    zero = round(height * (1 - ROOM - (1 - 2 * ROOM) * (0.0 - low) / spread))
    pygame.draw.line(graph, theme.AXIS, (0, zero), (width, zero))
    first = float(y[0, 2])
    pygame.draw.line(graph, theme.GRID_STRONG, (0, round(first)), (width, round(first)))
    every = max(len(points) // max(width, 1), 1)
    shown = np.append(np.arange(0, len(points) - 1, every), len(points) - 1)
    for series, (color, thickness, dashed) in enumerate(_series()):
        line = np.column_stack((x[shown], y[shown, series])).tolist()
        _draw(graph, line, color, thickness, dashed=dashed)
        pygame.draw.circle(graph, color, line[-1], 2 + thickness // 2)
    return graph


def sample(series: int, size: tuple[int, int]) -> pygame.Surface:
    """Draw a sample of one of the graph's lines, for the legend."""
    color, thickness, dashed = _series()[series]
    surface = pygame.Surface(size, pygame.SRCALPHA)
    _draw(surface, [(0, size[1] // 2), (size[0], size[1] // 2)], color, thickness, dashed=dashed)
    return surface


def _draw(
    surface: pygame.Surface, line: Sequence[XY], color: Color, thickness: int, *, dashed: bool
) -> None:
    for offset in range(thickness):
        moved = [(px, py + offset) for px, py in line]
        if dashed:
            lines.dashed(surface, color, moved, *DASH)
        elif len(moved) > 1:
            pygame.draw.aalines(surface, color, False, moved)


def _series() -> tuple[tuple[Color, int, bool], ...]:
    """Return the colour, thickness [px] and dashing of kinetic, potential and total energy."""
    return (theme.KINETIC, 1, False), (theme.POTENTIAL, 1, True), (theme.TOTAL, 2, False)
