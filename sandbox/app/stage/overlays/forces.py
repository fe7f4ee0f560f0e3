"""The overlay with all forces on the selected body, as arrows at their points of application."""

from math import hypot

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.observing import forces_on_selected_body
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.given_force_arrows import LONGEST, beside
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.model.effects.force import Force
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import FRICTION, FreeBody

WIDTH = 3.5  # px
CUT = 1.5
"""The largest arrow of an impact's force, relative to the longest arrow of other forces."""
SURFACE = 300.0  # px, the length of a surface, to either side, that labels avoid
RING = 4.0  # px, the radius of the mark at the centre of mass


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    found = view.looking.at(view.world) if view.looking else None
    if found is None or view.looking is None:
        return
    longest = LONGEST * view.camera.size[0]
    given_forces = _given(view, found)
    scale = given_forces or longest / (view.looking.force_of_longest_arrow(found) or 1.0)  # px/N
    ends = []
    words = forces_on_selected_body.texts(view.looking.as_last_shown(view.world, found))
    for acting, (_, text) in zip(forces_on_selected_body.not_negligible(found), words, strict=True):
        if given_forces and acting.name == Force.effect.shown_force_name:
            continue
        share = min(scale, CUT * longest / acting.magnitude)
        x, y = start = view.camera.to_screen(acting.at)
        end = x + acting.force[0] * share, y - acting.force[1] * share
        color = forces_on_selected_body.color(acting)
        lines.arrow(surface, color, start, end, WIDTH)
        ends.append((text, start, end, color, f"force {acting.name} {acting.by}"))
        _mark(view, acting.name, start, end)
    if lines.are_close((center := view.camera.to_screen(found.center),)):
        pygame.draw.aacircle(surface, theme.TEXT, center, RING, 2)
    avoid = view.boxes if view.few else ()
    written = [
        beside(surface, view.pen, text, start, end, view.labels, color, name, avoid)
        for text, start, end, color, name in ends
    ]
    shown = [each for each in written if each is not None]
    for each in shown:
        each.draw_leader(surface)
    surface.blits([(each.image, each.place) for each in shown])  # so that nothing covers them


def _mark(view: DrawingContext, name: str, start: XY, end: XY) -> None:
    """Keep labels off an arrow, and off the surface of a friction force."""
    view.labels.mark(start, end)
    if name == FRICTION:
        length = hypot(end[0] - start[0], end[1] - start[1]) or 1.0
        x, y = ((b - a) / length * SURFACE for a, b in zip(start, end, strict=True))
        view.labels.mark((start[0] - x, start[1] - y), (start[0] + x, start[1] + y))


def _given(view: DrawingContext, found: FreeBody) -> float:
    """Return the scale of the given forces [px/N], if their arrows are already drawn.

    0 if they are not, or if other forces would be too long at that scale.
    """
    if not (view.few and view.shown["arrows"]):
        return 0.0
    scale = view.forces.scale(view.camera)
    return scale if scale * found.largest <= CUT * LONGEST * view.camera.size[0] else 0.0


OVERLAY = Overlay(
    name="forces",
    key="u",
    text="all forces on the body that was clicked on",
    draw=_draw,
    caption="Forces",
    on=lambda _level: False,
)
