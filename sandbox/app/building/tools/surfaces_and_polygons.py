"""The tools for polygons, surfaces and freehand strokes, drawn through several points."""

from collections.abc import Callable
from functools import partial
from math import atan2, degrees, dist

import pygame

from sandbox.app.building import shape_preview
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition
from sandbox.app.building.tools.tool import Tool
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.app.words.language import later, say
from sandbox.editing.edits import bodies
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.foreseen_faults import Proposed
from sandbox.model.level import Level
from sandbox.model.shapes import XY

CLOSE = 9.0  # px, the largest distance from the first corner at which a click closes a polygon
APART = 3.0  # px, the least distance between two points of a stroke
OFF = 2.0  # px, the tolerance of the simplification of a stroke


class VertexTool(Tool):
    """Sets a point with each click; Enter, a double click, or a polygon's first corner finishes."""

    least = 2
    closed = False
    said = later("draw a surface")
    begins = later("Click where the surface begins")
    goes_on = later(
        "Click the next point; Enter or a double click ends it, Backspace takes one back"
    )

    def __init__(self, bench: EditedLevel) -> None:
        super().__init__(bench)
        self._points: list[XY] = []
        self._spot: MousePosition | None = None

    @property
    def busy(self) -> bool:
        """Whether a point is set."""
        return bool(self._points)

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        return self.goes_on if self.busy else self.begins

    @property
    def proposed(self) -> Proposed[EditResult] | None:
        """The edit that adds the shape, if it ended at the mouse."""
        if not self._points or self._spot is None:
            return None
        points = tuple(dict.fromkeys((*self._points, self._spot.point)))
        return Proposed(self.edit(points)) if len(points) >= self.least else None

    def press(self, mouse: MousePosition) -> None:
        """Set the next point, or finish."""
        self._spot = mouse
        if self._points and self._ends(mouse):
            self.finish()
        else:
            self._points.append(mouse.point)

    def _ends(self, mouse: MousePosition) -> bool:
        """Return whether a click finishes the shape."""
        camera = self._bench.camera
        last = dist(camera.to_screen(self._points[-1]), camera.to_screen(mouse.point)) < 1
        first = dist(camera.to_screen(self._points[0]), mouse.pixel) < CLOSE
        return last or (self.closed and first and len(self._points) >= self.least)

    def move(self, mouse: MousePosition) -> None:
        """Move the end of the preview."""
        self._spot = mouse

    def finish(self) -> None:
        """Make the shape, if it has enough points."""
        points = tuple(self._points)
        if len(points) >= self.least:
            self._points.clear()
            self._bench.add_parts(say(self.said), self.edit(points))

    def cancel(self) -> None:
        """Remove the last point."""
        if self._points:
            self._points.pop()

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the points, and the line to the mouse with its length and angle."""
        if not self._points or self._spot is None:
            return
        camera, end = self._bench.camera, self._spot.point
        shape_preview.outline(surface, camera, [*self._points, end], closed=self.closed)
        shape_preview.mark_points(surface, camera, self._points)
        x, y = end[0] - self._points[-1][0], end[1] - self._points[-1][1]
        length = shape_preview.metres(dist(end, self._points[-1]))
        message = f"{length}  {number(degrees(atan2(y, x)), 4)}°"
        shape_preview.write_measure(surface, pen, self._spot.pixel, message)

    def edit(self, points: tuple[XY, ...]) -> Callable[[str, Level], EditResult]:
        """Return the edit that adds the surface to the level."""
        return partial(bodies.add_surface, points=points)


class SurfaceTool(VertexTool):
    """Draws floors, slopes and walls."""


class PolygonTool(VertexTool):
    """Draws polygons, corner by corner."""

    least = 3
    closed = True
    said = later("draw a polygon")
    begins = later("Click the corners of the polygon, one after the other")
    goes_on = later(
        "Click the next corner; the first one or Enter closes it, Backspace takes one back"
    )

    def edit(self, points: tuple[XY, ...]) -> Callable[[str, Level], EditResult]:
        """Return the edit that adds a polygon to the level."""
        return partial(bodies.add_polygon, points=points)


class CurveTool(Tool):
    """Draws freehand strokes: a polygon if the stroke returns to its start, else a surface."""

    def __init__(self, bench: EditedLevel) -> None:
        super().__init__(bench)
        self._points: list[XY] = []
        self._pixels: list[XY] = []

    @property
    def busy(self) -> bool:
        """Whether a stroke is being drawn."""
        return bool(self._points)

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        return later("Draw while you press; come back to the beginning for a closed body")

    @property
    def proposed(self) -> Proposed[EditResult] | None:
        """The edit that adds the shape of the stroke."""
        if len(self._points) < 3:
            return None
        tolerance = OFF / self._bench.camera.scale
        edit = partial(bodies.add_curve, points=tuple(self._points), tolerance=tolerance)
        return Proposed(edit)

    def press(self, mouse: MousePosition) -> None:
        """Start a stroke."""
        self._points, self._pixels = [mouse.point], [mouse.pixel]

    def move(self, mouse: MousePosition) -> None:
        """Continue the stroke."""
        if self._pixels and dist(mouse.pixel, self._pixels[-1]) >= APART:
            self._points.append(mouse.unsnapped)
            self._pixels.append(mouse.pixel)

    def release(self, mouse: MousePosition) -> None:
        """Make the shape of the stroke, if it is more than a click."""
        self.move(mouse)
        proposed = self.proposed
        self.cancel()
        if proposed:
            self._bench.add_parts(say("draw freely"), proposed.edit)

    def cancel(self) -> None:
        """Discard the stroke."""
        self._points, self._pixels = [], []

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:  # noqa: ARG002 (nothing to write)
        """Draw the stroke."""
        shape_preview.outline(surface, self._bench.camera, self._points)
