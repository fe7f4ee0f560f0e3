"""The overlay with flashes at impacts, larger for harder ones."""

from functools import lru_cache
from math import hypot, sqrt

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay

LARGEST, SMALLEST = 30, 6  # px, bounds of the radius for the hardest, about that of the body
LEAST = 0.35
"""The radius of the faintest flash, relative to the hardest."""
WAVE = 1.4
"""How far the ring around a flash spreads, relative to the flash."""
DYING = 0.25
"""Below this brightness the ring is left out."""
RINGS = 12
"""The number of concentric discs of a glow."""
MOST = 24
"""The largest number of flashes that are drawn at once, the latest."""


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    names = list(view.outlines) if view.flashes else ()
    for blow, left in view.flashes[:MOST]:
        center = view.camera.to_screen(blow.at)
        if not lines.are_close((center,)):
            continue
        reach = max(hypot(x, y) for x, y in view.outlines[names[blow.body]].points)
        full = min(max(reach * view.camera.scale, SMALLEST), LARGEST)
        radius = view.pen.px(round(full * (LEAST + (1 - LEAST) * sqrt(blow.strength))))
        if left > DYING:
            wave = radius * (1 + WAVE * (1 - left))
            pygame.draw.aacircle(surface, theme.faded(theme.FLAME, left), center, wave, 2)
        glow = _glow(theme.FLAME_CORE, theme.FLAME, max(radius, 2))
        glow.set_alpha(round(255 * left))
        surface.blit(glow, glow.get_rect(center=center))


@lru_cache(maxsize=64)
def _glow(core: Color, rim: Color, radius: int) -> pygame.Surface:
    """Draw a disc that fades from one colour to a transparent rim of another."""
    drawn = pygame.Surface((2 * radius + 1, 2 * radius + 1), pygame.SRCALPHA)
    drawn.fill((*rim, 0))
    for ring in range(RINGS, 0, -1):
        share = ring / RINGS
        color = (*theme.mix(core, rim, share), round(255 * (1 - share**2)))
        pygame.draw.circle(drawn, color, (radius, radius), radius * share)
    return drawn


OVERLAY = Overlay(name="flashes", key="!", text="flashes where bodies strike", draw=_draw)
