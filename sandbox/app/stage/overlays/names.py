"""The overlay with the names of moving bodies."""

import pygame

from sandbox.app.stage import motion_annotations
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    if view.few:
        named = [(outline, *view.state(outline)) for outline in view.moving]
        motion_annotations.draw_names(surface, view.camera, view.pen, named, view.labels)


OVERLAY = Overlay(name="names", key="n", text="names", draw=_draw, caption="Names")
