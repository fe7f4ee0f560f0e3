"""The overlay with the velocities of points of each rigid body, and where it turns at the moment.

A point at r from the centre of mass has the velocity v + w x r. There is one point, on the body or
off it, that is at rest: the instantaneous centre of rotation, at (-vy, vx) / w from the centre of
mass. All others go round it.
"""

from math import cos, dist, hypot, sin, tau

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.stage import overlay_legend
from sandbox.app.stage.body_outlines import Outline
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.arrows import time_ahead
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.words.language import say
from sandbox.model.shapes import XY

AROUND = 8
"""The number of points on the rim of a disc, and the largest number of a polygon's corners."""
RADIUS = 5.0  # px, of the sign of the centre of rotation
WIDTH = 2.0  # px, of an arrow
AT_REST = 1e-9
"""A body turns if it rotates by more than this in the time of an arrow [rad]."""

ALIKE = 0.25
"""A body is taken to move as a whole if the ratio of its velocity of turning to that of its centre
of mass is below this."""


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    ahead = time_ahead(view)
    if ahead is None:
        return
    turns = False
    for outline in view.moving:
        spin = float(view.world.snapshot.angular_velocity[outline.row])
        if abs(spin) * ahead > AT_REST:
            turns = True
            _draw_velocities(surface, view, outline, spin, ahead)
            _draw_center(surface, view, outline, spin)
    if turns:
        row = (_sample, say("turns about this point now"))
        overlay_legend.draw(surface, view, [row], "key of turning")


def _draw_velocities(
    surface: pygame.Surface, view: DrawingContext, outline: Outline, spin: float, ahead: float
) -> None:
    """Draw the displacement of points of a body in some time [s], at a rate of turning [rad/s].

    Nothing is drawn where all of them are nearly alike.
    """
    (x, y), angle = view.state(outline)
    vx, vy = view.velocity(outline)
    points = _points(outline, (x, y), angle)
    if abs(spin) * max(dist((x, y), point) for point in points) < ALIKE * hypot(vx, vy):
        return
    for px, py in points:
        u, v = vx - spin * (py - y), vy + spin * (px - x)
        start = view.camera.to_screen((px, py))
        end = view.camera.to_screen((px + u * ahead, py + v * ahead))
        lines.arrow(surface, theme.ARROW, start, end, WIDTH)


def _points(outline: Outline, place: XY, angle: float) -> list[XY]:
    """Return points on the rim of a body [m]."""
    if outline.radius is not None:
        turns = (angle + tau * i / AROUND for i in range(AROUND))
        (x, y), r = place, outline.radius
        return [(x + r * cos(turn), y + r * sin(turn)) for turn in turns]
    corners = outline.placed(place, angle)
    return corners[:: -(-len(corners) // AROUND)]


def center_of_rotation(view: DrawingContext, outline: Outline, spin: float) -> XY:
    """Return the point about which a body turns at a rate [rad/s], as the observer sees it [m]."""
    (x, y), (vx, vy) = view.state(outline)[0], view.velocity(outline)
    return x - vy / spin, y + vx / spin


def _draw_center(
    surface: pygame.Surface, view: DrawingContext, outline: Outline, spin: float
) -> None:
    """Mark the instantaneous centre of rotation, with a dashed line from the body to it."""
    center = view.camera.to_screen(center_of_rotation(view, outline, spin))
    if not surface.get_rect().collidepoint(center):
        return
    body = view.camera.to_screen(view.state(outline)[0])
    if dist(center, body) > 2 * RADIUS:
        lines.dashed(surface, theme.faded(outline.color, 0.7), (body, center), 3, 4)
    _mark(surface, center)


def _mark(surface: pygame.Surface, center: XY) -> None:
    pygame.draw.aacircle(surface, theme.STAGE, center, RADIUS + 1)
    pygame.draw.aacircle(surface, theme.NOTICE, center, RADIUS, 2)
    pygame.draw.aacircle(surface, theme.NOTICE, center, 1.5)


def _sample(surface: pygame.Surface, start: XY, end: XY) -> None:
    _mark(surface, ((start[0] + end[0]) / 2, start[1]))


OVERLAY = Overlay(
    name="rotation_velocities_and_center",
    key="7",
    text="velocities all over each body, and the point about which it turns",
    draw=_draw,
    caption="Turning",
    on=lambda _level: False,
)
