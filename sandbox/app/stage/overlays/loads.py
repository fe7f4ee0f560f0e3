"""The overlay with the load of each joint: how strongly it pulls or pushes."""

from functools import partial
from itertools import pairwise
from math import dist

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.forces_on_selected_body import newtons
from sandbox.app.stage import overlay_legend
from sandbox.app.stage.drawing_context import NAMED, DrawingContext
from sandbox.app.stage.joint_polylines import path_of
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.words.language import say
from sandbox.model.joints import Pulley, Rod, Rope, Spring, Winding
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import NORMAL

ALONG = Rod | Rope | Spring | Pulley | Winding
"""The joints whose force acts along the line that is drawn."""
WIDTHS = 2.0, 10.0  # px, of the line of the weakest and of the strongest
DASH = 7, 6  # px, of a joint that pushes
FAINT = 1e-9
"""A load below this fraction of the largest so far counts as a rounding error."""
LEAST = 6.0  # px, the length below which no load is drawn


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    world, t = view.world, float(view.world.snapshot.t)
    joints = world.scene.joints
    loads = {
        name: float(joints.tension(name, world.snapshot))
        for name, joint in world.level.joints.items()
        if isinstance(joint, ALONG) and joints.holds(name, t)
    }
    full = view.full_length_value("loads", max(map(abs, loads.values()), default=0.0))
    if not full:
        return
    for name, load in loads.items():
        path = view.camera.path(_path(view, name))
        if abs(load) > FAINT * full and lines.are_close(path) and dist(path[0], path[-1]) > LEAST:
            _draw_load(surface, path, load / full)
            if len(loads) <= NAMED:
                _write(surface, view, name, path, load)
    rows = (
        (partial(_sample, share=1.0), say("pulls, {force} N", force=newtons(full))),
        (partial(_sample, share=-0.5), say("pushes, {force} N", force=newtons(full / 2))),
    )
    overlay_legend.draw(surface, view, rows, "key of loads")


def _path(view: DrawingContext, name: str) -> list[XY]:
    """Return the points through which a joint is drawn [m]."""
    joint = view.world.level.joints[name]
    return path_of(
        view.camera, view.world, name, joint, lambda body: view.state(view.outlines[body])[1]
    )


def _draw_load(surface: pygame.Surface, path: list[XY], share: float) -> None:
    """Draw a line for a share of the largest load, which is negative if the joint pushes."""
    width = WIDTHS[0] + (WIDTHS[1] - WIDTHS[0]) * min(abs(share), 1.0)
    if share > 0:
        lines.path(surface, _color(share), path, width)
        return
    for a, b in lines.dashes(path, *DASH):
        lines.stroke(surface, _color(share), a, b, width)


def _write(
    surface: pygame.Surface, view: DrawingContext, name: str, path: list[XY], load: float
) -> None:
    """Write the load beside the middle of the longest straight part of its joint."""
    a, b = max(pairwise(path), key=lambda piece: dist(*piece))
    x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    text = view.pen.outlined(f"{newtons(abs(load))} N", color=_color(load))
    places = (
        text.get_rect(midleft=(x + WIDTHS[1], y)),
        text.get_rect(midright=(x - WIDTHS[1], y)),
        text.get_rect(midbottom=(x, y - WIDTHS[1])),
        text.get_rect(midtop=(x, y + WIDTHS[1])),
    )
    if place := view.labels.place_for(places, name=f"load {name}"):
        surface.blit(text, place)


def _color(load: float) -> Color:
    """Return the colour of what pulls, or of what pushes as a surface does."""
    return theme.ACTING["tension" if load > 0 else NORMAL]


def _sample(surface: pygame.Surface, start: XY, end: XY, *, share: float) -> None:
    _draw_load(surface, [start, end], share)


OVERLAY = Overlay(
    name="loads",
    key="5",
    text="how strongly ropes, rods and springs pull or push",
    draw=_draw,
    caption="Loads",
    on=lambda _level: False,
)
