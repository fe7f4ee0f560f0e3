"""The tools for discs and boxes, drawn from one point to another."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import partial
from math import cos, dist, sin, tau

import pygame

from sandbox.app.building import shape_preview
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition
from sandbox.app.building.tools.tool import STILL, Tool
from sandbox.app.drawing.text import Pen
from sandbox.app.words.language import later, say
from sandbox.editing.edits import bodies
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.foreseen_faults import Proposed
from sandbox.editing.snapping import grid_step
from sandbox.model.level import Level
from sandbox.model.shapes import XY

FINER = 10
"""The factor by which the grid is finer for shapes that are too small for it."""


class DragTool(Tool, ABC):
    """Draws by pressing, dragging and releasing, or by two clicks."""

    begins = ""
    """The hint for the first point."""
    said = ""
    """The description of the edit."""

    def __init__(self, bench: EditedLevel) -> None:
        super().__init__(bench)
        self._start: MousePosition | None = None
        self._end: MousePosition | None = None

    @property
    def busy(self) -> bool:
        """Whether the first point is set."""
        return self._start is not None

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        return later("Release, or click, where it ends") if self.busy else self.begins

    @property
    def proposed(self) -> Proposed[EditResult] | None:
        """The edit that adds the shape."""
        if self._start is None or self._end is None:
            return None
        one, other = self._start.point, self._reached(self._start, self._end)
        return None if self.is_flat(one, other) else Proposed(self.edit(one, other))

    def press(self, mouse: MousePosition) -> None:
        """Set the first point."""
        if self._start is None:
            self._start = mouse
        self._end = mouse

    def move(self, mouse: MousePosition) -> None:
        """Move the second point of the preview."""
        self._end = mouse

    def release(self, mouse: MousePosition) -> None:
        """Make the shape if the mouse has moved; else a second click makes it."""
        if self._start is None or dist(mouse.pixel, self._start.pixel) < STILL:
            return
        one, other = self._start.point, self._reached(self._start, mouse)
        self.cancel()
        self._bench.add_parts(say(self.said), self.edit(one, other))

    def cancel(self) -> None:
        """Forget the first point."""
        self._start = self._end = None

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the outline and the measures of the shape."""
        if self._start is None or self._end is None:
            return
        one, other = self._start.point, self._reached(self._start, self._end)
        camera = self._bench.camera
        shape_preview.outline(surface, camera, self.corners(one, other), closed=True)
        shape_preview.mark_points(surface, camera, [one])
        shape_preview.write_measure(surface, pen, self._end.pixel, self.measured(one, other))

    def _reached(self, start: MousePosition, end: MousePosition) -> XY:
        """Return the second point [m], on a finer grid if the shape is too small for this one."""
        if not self.is_flat(start.point, end.point):
            return end.point
        fine = grid_step(1 / self._bench.camera.scale) / FINER
        both = zip(start.pixel, end.pixel, start.point, end.point, end.unsnapped, strict=True)
        x, y = (
            round(free / fine) * fine if to == at and abs(drawn - begun) >= STILL else to
            for begun, drawn, at, to, free in both
        )
        return x, y

    @abstractmethod
    def is_flat(self, one: XY, other: XY) -> bool:
        """Return whether the shape would have no area."""

    @abstractmethod
    def edit(self, one: XY, other: XY) -> Callable[[str, Level], EditResult]:
        """Return the edit that adds the shape to the level."""

    @abstractmethod
    def corners(self, one: XY, other: XY) -> list[XY]:
        """Return the outline of the shape [m]."""

    @abstractmethod
    def measured(self, one: XY, other: XY) -> str:
        """Return the measures of the shape as text."""


class DiscTool(DragTool):
    """Draws discs from their centres."""

    begins = later("Press at the disc's centre, and drag to its rim")
    said = later("draw a disc")

    def is_flat(self, one: XY, other: XY) -> bool:
        """Return whether the radius is zero."""
        return one == other

    def edit(self, one: XY, other: XY) -> Callable[[str, Level], EditResult]:
        """Return the edit that adds a disc to the level."""
        return partial(bodies.add_disc, center=one, rim=other)

    def corners(self, one: XY, other: XY) -> list[XY]:
        """Return points of the circle [m]."""
        radius = dist(one, other)
        turns = (tau * i / 48 for i in range(48))
        return [(one[0] + radius * cos(a), one[1] + radius * sin(a)) for a in turns]

    def measured(self, one: XY, other: XY) -> str:
        """Return the radius as text."""
        return f"r {shape_preview.metres(dist(one, other))}"


class BoxTool(DragTool):
    """Draws boxes from corner to corner."""

    begins = later("Press at one corner of the box, and drag to the opposite one")
    said = later("draw a box")

    def is_flat(self, one: XY, other: XY) -> bool:
        """Return whether the width or the height is zero."""
        return one[0] == other[0] or one[1] == other[1]

    def edit(self, one: XY, other: XY) -> Callable[[str, Level], EditResult]:
        """Return the edit that adds a box to the level."""
        return partial(bodies.add_box, corner=one, opposite=other)

    def corners(self, one: XY, other: XY) -> list[XY]:
        """Return the corners of the rectangle [m]."""
        return [one, (other[0], one[1]), other, (one[0], other[1])]

    def measured(self, one: XY, other: XY) -> str:
        """Return the width and the height as text."""
        width, height = abs(other[0] - one[0]), abs(other[1] - one[1])
        return f"{shape_preview.metres(width)} × {shape_preview.metres(height)}"
