"""Snapping while something is drawn or moved, at the scale of the view."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from sandbox.app.building.mouse_position import SnappedPoint
from sandbox.app.drawing.camera import Camera
from sandbox.app.words.language import later, say
from sandbox.editing import snapping
from sandbox.editing.snapping import Kind
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.shapes import XY

TOLD: Mapping[Kind, str] = {
    "grid": later("grid"),
    "corner": later("corner"),
    "center": later("centre"),
    "end": later("end"),
    "line": later("in line"),
    "side": later("side"),
}
"""The descriptions of what a point snapped to."""

REACH = 10.0  # px, the distance within which a point or a body snaps


class Scene(Protocol):
    """The work, as far as snapping uses it."""

    camera: Camera
    ignored: frozenset[str]

    @property
    def level(self) -> Level:
        """The level under edit."""


class Snapping:
    """Snaps points to the grid, to ends and centres, and bodies to where they touch."""

    def __init__(self, work: Scene) -> None:
        self._work = work

    @property
    def grid(self) -> float:
        """The spacing of the grid [m]."""
        return snapping.grid_step(1 / self._work.camera.scale)

    @property
    def _reach(self) -> float:
        return REACH / self._work.camera.scale

    def point(self, free: XY, *, in_line: bool = False) -> SnappedPoint:
        """Return a point after snapping, with `in_line` also to the lines of moving bodies."""
        work = self._work
        try:
            found = snapping.snap_point(
                work.level, free, self._reach, self.grid, work.ignored, in_line=in_line
            )
        except SandboxError:  # the last edit made an invalid level, and will be undone
            return SnappedPoint(free, "")
        return SnappedPoint(found.point, TOLD.get(found.kind, "") if found.kind else "")

    def moved(self, names: Sequence[str], by: XY) -> SnappedPoint:
        """Return the displacement with which bodies touch what they come near [m]."""
        try:
            found = snapping.snap_body(self._work.level, names, by, self._reach, self.grid)
        except SandboxError:
            return SnappedPoint(by, "")
        touched = say(" and ").join(found.bodies)
        touches = say("touches {bodies}", bodies=touched) if found.kind == "contact" else ""
        return SnappedPoint(found.point, touches)
