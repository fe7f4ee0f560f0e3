"""The overlay with the momenta of bodies as arrows."""

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.stage import momentum_scale
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.motion_annotations import LONGEST
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.words.formatting import nice

WIDTH = 6.0  # px, wide enough to be seen below the arrow of the velocity
KEY = 16, 112, 130, 40  # px, of the key: from the right, from below, width, height


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    if not view.few:
        return
    place = view.observer.place
    full = momentum_scale.scale(view, view.world, view.world.snapshot, place)
    if not full:
        return
    length = LONGEST * view.camera.size[0] / full  # px for 1 kg m/s
    every = momentum_scale.momenta(view.world, view.world.snapshot, place)
    for row, name in momentum_scale.bodies_with_momentum(view.world):
        x, y = view.camera.to_screen(view.state(view.outlines[name])[0])
        px, py = every[row].tolist()
        end = x + px * length, y - py * length
        lines.arrow(surface, theme.RESULTANT, (x, y), end, WIDTH)
    _draw_key(surface, view, length)


def _draw_key(surface: pygame.Surface, view: DrawingContext, length: float) -> None:
    """Draw the key to the arrows' length, above that of the velocities."""
    value = nice(70 / length)
    right, below, width, height = map(view.pen.px, KEY)
    x, y = view.camera.size[0] - right, view.camera.size[1] - below
    text = view.pen.write(f"{value:g} {momentum_scale.UNIT}", 12)
    start = x - value * length
    lines.arrow(surface, theme.RESULTANT, (start, y), (x, y), WIDTH)
    surface.blit(text, (x - max(value * length, text.width), y - text.height - 3))
    view.labels.occupy(pygame.Rect(x + right - width, y - height + 8, width, height))


OVERLAY = Overlay(
    name="momenta",
    key="i",
    text="arrows of momenta",
    draw=_draw,
    caption="Momenta",
    on=lambda _level: False,
)
