"""Drawing the editor: the level under edit, the selection, and the mistakes."""

from collections.abc import Collection, Sequence
from math import sqrt

import pygame

from sandbox.app.building import shape_preview
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import Part
from sandbox.app.building.partial_level import PartialLevel, Parts
from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.grid import RULER
from sandbox.model.shapes import XY

WIDE = 2.0  # px, the width of the line around the selection
PADDING = 8  # px, around a hint
FRAME = 8.0  # px, between a group and the frame around it

caught = shape_preview.mark_snapped


class CachedDrawing:
    """A cached drawing of a level and the selection, until either or the camera changes."""

    def __init__(self) -> None:
        self._kept = pygame.Surface((1, 1))
        self._key: object = None

    def of(self, work: EditedLevel, pen: Pen) -> pygame.Surface:
        """Return the picture of the level under edit."""
        camera = work.camera
        key = camera.center, camera.scale, camera.size, work.version, work.selected
        if key != self._key:
            if self._kept.size != camera.size:
                self._kept = pygame.Surface(camera.size)
            self._key = key
            work.sketch.draw(self._kept, camera, pen)
            draw_selected(self._kept, work.sketch, work.selected, camera)
            draw_groups(self._kept, work)
        return self._kept


def draw_selected(
    surface: pygame.Surface, sketch: PartialLevel, selected: Sequence[Part], camera: Camera
) -> None:
    """Draw a line around each selected part."""
    for family, name in selected:
        _around(surface, sketch, family, name, camera, theme.TEXT)


def draw_groups(surface: pygame.Surface, work: EditedLevel) -> None:
    """Draw a dashed frame around each group that is selected as a whole."""
    chosen, bodies = set(work.selected_bodies), work.sketch.bodies
    for group in work.groups:
        if chosen.issuperset(group):
            corners = work.camera.path([point for name in group for point in bodies[name].corners])
            (left, *_, right), (low, *_, high) = map(sorted, zip(*corners, strict=True))
            left, low, right, high = left - FRAME, low - FRAME, right + FRAME, high + FRAME
            box = [(left, low), (right, low), (right, high), (left, high), (left, low)]
            lines.dashed(surface, theme.ACCENT, box)


def draw_culprits(
    surface: pygame.Surface, sketch: Parts, names: Collection[str], camera: Camera
) -> None:
    """Mark the parts because of which the level cannot run."""
    for name in names:
        family = "bodies" if name in sketch.bodies else "joints"
        place = _around(surface, sketch, family, name, camera, theme.FAILED)
        if place is not None:
            x, y = place
            pygame.draw.aacircle(surface, theme.FAILED, (x, y), 9)
            lines.stroke(surface, theme.STAGE, (x, y - 5), (x, y + 1), 3)
            pygame.draw.aacircle(surface, theme.STAGE, (x, y + 5), 1.8)


def _around(
    surface: pygame.Surface, sketch: Parts, family: str, name: str, camera: Camera, color: Color
) -> XY | None:
    """Draw a line around a part, and return a point of it on the stage [px]."""
    points: Sequence[XY] = ()
    closed = False
    if family == "bodies" and name in sketch.bodies:
        body = sketch.bodies[name]
        if body.outline.radius is not None:
            return _around_disc(surface, camera, body.position, body.outline.radius, color)
        points, closed = body.corners, body.outline.closed
    elif family == "joints" and name in sketch.joints:
        points = sketch.joints[name].path
    return draw_around(surface, camera, points, color, closed=closed)


def _around_disc(
    surface: pygame.Surface, camera: Camera, center: XY, radius: float, color: Color
) -> XY | None:
    """Draw a line around a disc, and return its upper right point on the stage [px]."""
    (x, y), wide = camera.to_screen(center), max(radius * camera.scale, 2 * WIDE)
    if wide > lines.FAR or not lines.are_close([(x, y)]):
        return None
    pygame.draw.aacircle(surface, color, (x, y), wide + WIDE / 2, round(WIDE))
    return x + wide * sqrt(0.5), y - wide * sqrt(0.5)


def draw_around(
    surface: pygame.Surface,
    camera: Camera,
    points: Sequence[XY],
    color: Color | None = None,
    *,
    closed: bool,
) -> XY | None:
    """Draw a line through points of the plane [m], and return a point of it on the stage [px]."""
    corners, color = camera.path(points), color or theme.TEXT
    if not corners:
        return None
    if len(corners) == 1 or all(corner == corners[0] for corner in corners):
        pygame.draw.aacircle(surface, color, corners[0], 12, 2)
    else:
        lines.path(surface, color, [*corners, corners[0]] if closed else corners, WIDE)
    return corners[0] if not closed else max(corners, key=lambda corner: corner[0] - corner[1])


def draw_hint(surface: pygame.Surface, pen: Pen, text: str, *, refused: bool = False) -> None:
    """Write at the bottom of the stage what to do next, or why it is refused."""
    lines_of_text = pen.paragraph(text, surface.width - 80, 13)
    width = max(line.width for line in lines_of_text) + 2 * PADDING
    box = pygame.Rect(0, 0, width, sum(line.height for line in lines_of_text) + PADDING)
    box.midbottom = surface.width // 2, surface.height - pen.px(RULER) - 34
    pygame.draw.rect(surface, theme.PANEL, box, border_radius=5)
    pygame.draw.rect(surface, theme.FAILED if refused else theme.EDGE, box, 1, border_radius=5)
    y = box.y + PADDING // 2
    for line in lines_of_text:
        surface.blit(line, line.get_rect(midtop=(box.centerx, y)))
        y += line.height
