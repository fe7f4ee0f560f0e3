"""The overlay with the velocities of moving bodies, and the given forces, as arrows."""

import pygame

from sandbox.app.stage import motion_annotations
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay

AT_REST = 1e-6
"""Bodies that move by less than this fraction of the visible width in the level's duration count as
at rest."""


def time_ahead(view: DrawingContext) -> float | None:
    """Return the time that velocity arrows look ahead [s]; None if all bodies are at rest."""
    if not view.few or not view.moving or view.fastest * view.duration < AT_REST * view.width:
        return None
    return motion_annotations.LONGEST * view.width / view.fastest


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    if not view.few or not view.moving:
        return
    ahead = time_ahead(view)
    moves = [] if ahead is None else [(view.state(o)[0], view.velocity(o)) for o in view.moving]
    for (x, y), (vx, vy) in moves:
        end = x + vx * (ahead or 0.0), y + vy * (ahead or 0.0)
        view.labels.mark(view.camera.to_screen((x, y)), view.camera.to_screen(end))
    view.forces.draw(surface, view.camera, view.pen, view.world, view.labels)
    if ahead is None:
        return
    for place, velocity in moves:
        motion_annotations.draw_arrow(surface, view.camera, place, velocity, ahead)
    corner = view.camera.size[0] - 16.0, view.camera.size[1] - float(view.pen.px(66))
    motion_annotations.draw_arrow_key(surface, view.camera, view.pen, ahead, corner)


OVERLAY = Overlay(
    name="arrows",
    key="v",
    text="arrows of velocities and given forces",
    draw=_draw,
    caption="Arrows",
)
