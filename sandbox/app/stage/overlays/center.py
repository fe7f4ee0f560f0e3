"""The overlay with the centre of mass of the moving bodies."""

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.stage import momentum_scale
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay

RADIUS, ARM = 5, 9  # px, of the ring and of the cross in it


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    rows = [row for row, _ in momentum_scale.bodies_with_momentum(view.world)]
    if not rows:
        return
    snapshot, scene = view.world.snapshot, view.world.scene
    mass = (scene.mass * scene.mass_fraction(snapshot.t))[rows]
    x, y = view.camera.to_screen(tuple(mass @ snapshot.position[rows] / mass.sum()))
    if not lines.are_close(((x, y),)):
        return
    lines.cross(surface, theme.NOTICE, (x, y), ARM, 2)
    pygame.draw.aacircle(surface, theme.NOTICE, (x, y), RADIUS, 2)


OVERLAY = Overlay(
    name="center",
    key="'",
    text="centre of mass of all that moves",
    draw=_draw,
    caption="Centre of mass",
    on=lambda _level: False,
)
