"""The overlay with ghosts: bodies at the closed form's positions, unless the run is disturbed."""

import pygame

from sandbox.app.stage import motion_annotations
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    world, t = view.world, float(view.world.snapshot.t)
    if world.disturbed or t > view.duration * (1 + 1e-9):
        return
    for name, formulas in world.level.ghosts.items():
        where = motion_annotations.ghost_position(formulas, world.values, t)
        if where is not None:
            outline = view.outlines[name]
            angle = view.state(outline)[1]
            motion_annotations.draw_ghost(surface, view.camera, outline, where, angle)


def _draw_paths(surface: pygame.Surface, view: DrawingContext) -> None:
    world = view.world
    if world.disturbed or view.observer.place is not None:  # the paths are those on the ground
        return
    for formulas in world.level.ghosts.values():
        motion_annotations.draw_ghost_path(
            surface, view.camera, formulas, world.values, view.duration
        )


OVERLAY = Overlay(
    name="ghosts",
    key="g",
    text="ghost of the closed form",
    draw=_draw,
    draw_below=_draw_paths,
    caption="Ghost",
)
