"""The tool that selects, moves, rotates and resizes."""

from cmath import phase
from collections.abc import Sequence
from enum import Enum, auto
from functools import partial
from math import degrees, dist, pi, radians

import pygame

from sandbox.app.building import handles, preview
from sandbox.app.building.edited_level import Work
from sandbox.app.building.handles import Handle
from sandbox.app.building.partial_level import Drawn
from sandbox.app.building.pointer import Part, Snapped, Spot
from sandbox.app.building.tools.tool import STILL, Tool
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.app.words.language import later, say
from sandbox.editing.edits import transforms
from sandbox.editing.edits.handles import drag_handle
from sandbox.model.shapes import XY

STEP = radians(5)
"""rad, the step of a body's angle unless Alt is held."""


CROWD = 60
"""The largest number of moved bodies whose outlines are drawn; the frame of more is drawn."""

NOWHERE = Snapped((0.0, 0.0), "")


class Doing(Enum):
    """The action while the button is held."""

    NOTHING = auto()
    MOVING = auto()
    TURNING = auto()
    RESIZING = auto()
    CATCHING = auto()


class SelectTool(Tool):
    """Selects by clicks or with a rubber band, and changes the selection by its handles.

    A click selects a body with its group, a second click the body alone.
    """

    def __init__(self, bench: Work) -> None:
        super().__init__(bench)
        self._doing = Doing.NOTHING
        self._start: Spot | None = None
        self._now: Spot | None = None
        self._handle: Handle | None = None
        self._way = NOWHERE
        self._again: Part | None = None  # pressed while its group was selected

    @property
    def busy(self) -> bool:
        """Whether something is being dragged."""
        return self._doing is not Doing.NOTHING

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        if self._bench.selected:
            return later("Drag to move, a handle to turn or resize; arrows nudge, Delete removes")
        return later("Click a body or a joint to change it, or drag a frame around several")

    def press(self, spot: Spot) -> None:
        """Start dragging a handle, a part, or a rubber band."""
        bench = self._bench
        self._start = self._now = spot
        self._way = NOWHERE
        if body := self._single:
            self._handle = handles.at(handles.of(body, bench.camera), spot.pixel)
            if self._handle is not None:
                turning = self._handle.index == handles.TURN
                self._doing = Doing.TURNING if turning else Doing.RESIZING
                return
        part = bench.part_at(spot.pixel)
        if part is None:
            self._doing = Doing.CATCHING
            return
        group = bench.with_group(part)
        self._again = part if set(group) == set(bench.selected) else None
        self._choose(group, more=spot.shift)
        self._doing = Doing.MOVING
        bench.ignored = frozenset(self._moved)

    def _choose(self, group: tuple[Part, ...], *, more: bool) -> None:
        """Select a part with its group; with `more`, add it to the selection or remove it."""
        chosen = self._bench.selected
        there = set(group) <= set(chosen)
        if more:
            kept = tuple(p for p in chosen if p not in group)
            self._bench.select(kept if there else (*kept, *group))
        elif not there:
            self._bench.select(group)

    @property
    def _single(self) -> Drawn | None:
        """The selected body, if a single one is selected."""
        chosen = self._bench.selected
        if len(chosen) == 1 and chosen[0][0] == "bodies":
            return self._bench.sketch.bodies.get(chosen[0][1])
        return None

    @property
    def _moved(self) -> list[str]:
        """The selected bodies."""
        return [name for family, name in self._bench.selected if family == "bodies"]

    def move(self, spot: Spot) -> None:
        """Drag whatever is held."""
        if self._start is None or self._doing is Doing.NOTHING:
            return
        self._now = spot
        if self._doing is Doing.MOVING and dist(spot.pixel, self._start.pixel) >= STILL:
            (x, y), (a, b) = spot.free, self._start.free
            self._way = self._snapped((x - a, y - b), spot)

    def _snapped(self, by: XY, spot: Spot) -> Snapped:
        """Return the displacement of the selection [m]; with Alt it does not snap."""
        moved = self._moved
        return (
            self._bench.snapping.moved(moved, by) if moved and not spot.loose else Snapped(by, "")
        )

    def release(self, spot: Spot) -> None:
        """Apply the drag, or select the parts inside the rubber band."""
        start, doing = self._start, self._doing
        if start is None:
            return
        self.move(spot)
        still = dist(spot.pixel, start.pixel) < STILL
        by, turned, handle = self._way.point, self._turn, self._handle
        body, caught = self._single, self._caught()
        self.cancel()
        if doing is Doing.CATCHING:
            kept = self._bench.selected if spot.shift else ()
            found = dict.fromkeys(p for part in caught for p in self._bench.with_group(part))
            self._bench.select((*kept, *(p for p in found if p not in kept)))
        elif still:
            if doing is Doing.MOVING and self._again and not spot.shift:
                self._bench.select((self._again,))
        elif doing is Doing.MOVING and by != (0.0, 0.0):
            self._move_by(by)
        elif doing is Doing.TURNING and body and turned:
            self._turn_by(body, turned)
        elif doing is Doing.RESIZING and body and handle:
            self._drag_handle(body.outline.name, handle.index, spot.point)

    def _move_by(self, by: XY) -> None:
        if moved := self._moved:
            self._bench.change(say("move"), partial(transforms.move, names=moved, by=by))

    def _turn_by(self, body: Drawn, by: float) -> None:
        edit = partial(transforms.turn, names=[body.outline.name], angle=by, about=body.position)
        self._bench.change(say("turn"), edit)

    def _drag_handle(self, name: str, index: int, to: XY) -> None:
        self._bench.change(say("resize"), partial(drag_handle, name=name, index=index, to=to))

    def cancel(self) -> None:
        """Cancel the drag."""
        self._doing, self._handle, self._start, self._now = Doing.NOTHING, None, None, None
        self._way = NOWHERE
        self._bench.ignored = frozenset()

    @property
    def _turn(self) -> float:
        """The rotation of the body [rad]."""
        body, start, now = self._single, self._start, self._now
        if self._doing is not Doing.TURNING or not (body and start and now):
            return 0.0
        center = complex(*body.position)
        by = phase((complex(*now.free) - center) / ((complex(*start.free) - center) or 1))
        if now.loose:
            return by
        return round((body.angle + by) / STEP) * STEP - body.angle

    def _caught(self) -> list[Part]:
        """Return the parts that are wholly within the rubber band."""
        if self._doing is not Doing.CATCHING or self._start is None or self._now is None:
            return []
        (x, y), (a, b) = self._start.free, self._now.free
        if dist(self._start.pixel, self._now.pixel) < STILL:
            return []
        sketch = self._bench.sketch

        def inside(points: list[XY] | tuple[XY, ...]) -> bool:
            return all(
                min(x, a) <= px <= max(x, a) and min(y, b) <= py <= max(y, b) for px, py in points
            )

        bodies = [("bodies", n) for n, body in sketch.bodies.items() if inside(body.corners)]
        joints = [("joints", n) for n, joint in sketch.joints.items() if inside(joint.path)]
        return [*bodies, *joints]

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the handles, or the preview of the drag."""
        start, now, body = self._start, self._now, self._single
        if body and self._doing in (Doing.NOTHING, Doing.CATCHING):
            handles.draw(surface, body, self._bench.camera)
        if start is None or now is None or dist(start.pixel, now.pixel) < STILL:
            return
        match self._doing:
            case Doing.CATCHING:
                self._draw_band(surface, start, now)
            case Doing.MOVING:
                self._draw_moved(surface, pen, now)
            case Doing.TURNING if body:
                self._draw_turned(surface, pen, body, now)
            case Doing.RESIZING if body and self._handle:
                self._draw_resized(surface, pen, body, self._handle, now)

    @staticmethod
    def _draw_band(surface: pygame.Surface, start: Spot, now: Spot) -> None:
        (x, y), (a, b) = start.pixel, now.pixel
        band = pygame.Rect(min(x, a), min(y, b), abs(x - a), abs(y - b))
        pygame.draw.rect(surface, theme.ACCENT, band, 1)

    def _draw_moved(self, surface: pygame.Surface, pen: Pen, now: Spot) -> None:
        dx, dy = self._way.point
        bodies = [self._bench.sketch.bodies[name] for name in self._moved]
        outlines = [(body.corners, body.outline.closed) for body in bodies[:CROWD]]
        if len(bodies) > CROWD:
            outlines = [(_frame(bodies), True)]
        for corners, closed in outlines:
            moved = [(x + dx, y + dy) for x, y in corners]
            preview.outline(surface, self._bench.camera, moved, closed=closed)
        message = f"Δx {preview.metres(dx)}  Δy {preview.metres(dy)}  {self._way.by}"
        preview.measure(surface, pen, now.pixel, message.strip())

    def _draw_turned(self, surface: pygame.Surface, pen: Pen, body: Drawn, now: Spot) -> None:
        angle = body.angle + self._turn
        corners = body.outline.placed(body.position, angle)
        preview.outline(surface, self._bench.camera, corners, closed=body.outline.closed)
        shown = degrees((angle + pi) % (2 * pi) - pi)
        preview.measure(surface, pen, now.pixel, f"{number(shown, 4)}°")

    def _draw_resized(
        self, surface: pygame.Surface, pen: Pen, body: Drawn, handle: Handle, now: Spot
    ) -> None:
        local = handles.dragged(body, handle.index, now.point)
        corners = [handles.in_plane(body, point) for point in local]
        preview.outline(surface, self._bench.camera, corners, closed=body.outline.closed)
        xs, ys = zip(*local, strict=True)
        width, height = max(xs) - min(xs), max(ys) - min(ys)
        message = f"{preview.metres(width)} × {preview.metres(height)}"
        if body.outline.radius is not None:
            message = f"r {preview.metres(width / 2)}"
        preview.measure(surface, pen, now.pixel, message)


def _frame(bodies: Sequence[Drawn]) -> list[XY]:
    """Return the corners of the bounding box of the positions of bodies [m]."""
    xs, ys = zip(*(body.position for body in bodies), strict=True)
    return [(min(xs), min(ys)), (max(xs), min(ys)), (max(xs), max(ys)), (min(xs), max(ys))]
