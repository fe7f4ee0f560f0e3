"""The overlay with the components of the velocities, beside the velocity arrows."""

import pygame

from sandbox.app.stage import motion_annotations
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays import arrows as arrows
from sandbox.app.stage.overlays.overlay import Overlay


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    ahead = arrows.time_ahead(view) if view.shown[arrows.OVERLAY.name] else None
    if ahead is None:
        return
    for outline in view.moving:
        position, velocity = view.state(outline)[0], view.velocity(outline)
        motion_annotations.draw_components(
            surface, view.camera, view.pen, position, velocity, ahead
        )


OVERLAY = Overlay(
    name="components",
    key="c",
    text="components of the velocities",
    draw=_draw,
    caption="Components",
    on=lambda level: level.view.components,
)
