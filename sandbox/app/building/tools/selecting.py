"""The tool that selects, moves, rotates and resizes."""

from cmath import phase, rect
from collections.abc import Sequence
from enum import Enum, auto
from functools import partial
from math import degrees, dist, pi, radians

import pygame

from sandbox.app.building import selection_handles, shape_preview
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition, Part, SnappedPoint
from sandbox.app.building.partial_level import DrawableBody
from sandbox.app.building.selection_handles import Handle
from sandbox.app.building.tools.tool import STILL, Tool
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import number
from sandbox.app.words.language import later, say
from sandbox.editing.edits import moving_and_aligning
from sandbox.editing.edits.resizing import drag_handle
from sandbox.editing.foreseen_faults import Proposed
from sandbox.model.shapes import XY

STEP = radians(5)
"""rad, the step of a body's angle unless Alt is held."""


CROWD = 60
"""The largest number of bodies that are rotated, or whose outlines are drawn while they are moved;
of more, the frame is drawn."""

NOWHERE = SnappedPoint((0.0, 0.0), "")


class DragKind(Enum):
    """The action while the button is held."""

    NOTHING = auto()
    MOVING = auto()
    TURNING = auto()
    RESIZING = auto()
    CATCHING = auto()


SAID = {
    DragKind.MOVING: later("move"),
    DragKind.TURNING: later("turn"),
    DragKind.RESIZING: later("resize"),
}
"""The descriptions of the edits."""


class SelectTool(Tool):
    """Selects by clicks or with a rubber band, and changes the selection by its handles.

    A click selects a body with its group, a second click the body alone.
    """

    def __init__(self, bench: EditedLevel) -> None:
        super().__init__(bench)
        self._doing = DragKind.NOTHING
        self._start: MousePosition | None = None
        self._now: MousePosition | None = None
        self._handle: Handle | None = None
        self._way = NOWHERE
        self._again: Part | None = None  # pressed while its group was selected

    @property
    def busy(self) -> bool:
        """Whether something is being dragged."""
        return self._doing is not DragKind.NOTHING

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        if self._bench.selected:
            return later("Drag to move, a handle to turn or resize; arrows nudge, Delete removes")
        return later("Click a body or a joint to change it, or drag a frame around several")

    @property
    def proposed(self) -> Proposed[str] | None:
        """The edit of the drag."""
        now, body, moved = self._now, self._single, self._moved
        if now is None or self._start is None or dist(now.pixel, self._start.pixel) < STILL:
            return None
        match self._doing:
            case DragKind.MOVING if moved and self._way.point != (0.0, 0.0):
                return Proposed(
                    partial(moving_and_aligning.move, names=moved, by=self._way.point), moved
                )
            case DragKind.TURNING if self._held and (angle := self._turn):
                return _turning(self._held, angle)
            case DragKind.RESIZING if body and self._handle:
                return _resizing(body, self._handle, now.point)
        return None

    def press(self, mouse: MousePosition) -> None:
        """Start dragging a handle, a part, or a rubber band."""
        bench = self._bench
        self._start = self._now = mouse
        self._way = NOWHERE
        if bodies := self._held:
            self._handle = selection_handles.at(
                selection_handles.of(bodies, bench.camera), mouse.pixel
            )
            if self._handle is not None:
                turning = self._handle.index == selection_handles.TURN
                self._doing = DragKind.TURNING if turning else DragKind.RESIZING
                return
        part = bench.part_at(mouse.pixel)
        if part is None:
            self._doing = DragKind.CATCHING
            return
        group = bench.with_group(part)
        self._again = part if set(group) == set(bench.selected) else None
        self._choose(group, more=mouse.shift)
        self._doing = DragKind.MOVING
        bench.ignored = frozenset(self._moved)

    def _choose(self, group: tuple[Part, ...], *, more: bool) -> None:
        """Select a part with its group; with `more`, add it to the selection or remove it."""
        chosen = self._bench.selected
        all_chosen = set(group) <= set(chosen)
        if more:
            rest = tuple(p for p in chosen if p not in group)
            self._bench.select(rest if all_chosen else (*rest, *group))
        elif not all_chosen:
            self._bench.select(group)

    @property
    def _held(self) -> list[DrawableBody]:
        """The selected bodies that the handles act on: a single one, or several to be rotated."""
        chosen, bodies = self._bench.selected, self._bench.sketch.bodies
        moved = self._moved
        if len(chosen) == 1 or 1 < len(moved) <= CROWD:
            return [bodies[name] for name in moved if name in bodies]
        return []

    @property
    def _single(self) -> DrawableBody | None:
        """The selected body, if a single one is selected."""
        handle = self._held
        return handle[0] if len(handle) == 1 else None

    @property
    def _moved(self) -> list[str]:
        """The selected bodies."""
        return [name for family, name in self._bench.selected if family == "bodies"]

    def move(self, mouse: MousePosition) -> None:
        """Drag whatever is held."""
        if self._start is None or self._doing is DragKind.NOTHING:
            return
        self._now = mouse
        if self._doing is DragKind.MOVING and dist(mouse.pixel, self._start.pixel) >= STILL:
            (x, y), (a, b) = mouse.unsnapped, self._start.unsnapped
            self._way = self._snapped((x - a, y - b), mouse)

    def _snapped(self, by: XY, mouse: MousePosition) -> SnappedPoint:
        """Return the displacement of the selection [m]; with Alt it does not snap."""
        moved = self._moved
        return (
            self._bench.snapping.moved(moved, by)
            if moved and not mouse.is_snapping_off
            else SnappedPoint(by, "")
        )

    def release(self, mouse: MousePosition) -> None:
        """Apply the drag, or select the parts inside the rubber band."""
        start, doing = self._start, self._doing
        if start is None:
            return
        self.move(mouse)
        still = dist(mouse.pixel, start.pixel) < STILL
        proposed, caught = self.proposed, self._parts_in_band()
        self.cancel()
        if doing is DragKind.CATCHING:
            kept = self._bench.selected if mouse.shift else ()
            found = dict.fromkeys(p for part in caught for p in self._bench.with_group(part))
            self._bench.select((*kept, *(p for p in found if p not in kept)))
        elif still:
            if doing is DragKind.MOVING and self._again and not mouse.shift:
                self._bench.select((self._again,))
        elif proposed:
            self._bench.change(say(SAID[doing]), proposed.edit)

    def cancel(self) -> None:
        """Cancel the drag."""
        self._doing, self._handle, self._start, self._now = DragKind.NOTHING, None, None, None
        self._way = NOWHERE
        self._bench.ignored = frozenset()

    @property
    def _turn(self) -> float:
        """The rotation of the selection [rad]."""
        handle, start, now = self._held, self._start, self._now
        if self._doing is not DragKind.TURNING or not (handle and start and now):
            return 0.0
        center, angle = complex(*selection_handles.middle(handle)), self._angle
        by = phase((complex(*now.unsnapped) - center) / ((complex(*start.unsnapped) - center) or 1))
        return by if now.is_snapping_off else round((angle + by) / STEP) * STEP - angle

    @property
    def _angle(self) -> float:
        """The angle of a single body; of several, 0, as they have none in common [rad]."""
        return self._single.angle if self._single else 0.0

    def _parts_in_band(self) -> list[Part]:
        """Return the parts that are wholly within the rubber band."""
        if self._doing is not DragKind.CATCHING or self._start is None or self._now is None:
            return []
        (x, y), (a, b) = self._start.unsnapped, self._now.unsnapped
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
        if self._held and self._doing in (DragKind.NOTHING, DragKind.CATCHING):
            selection_handles.draw(surface, self._held, self._bench.camera)
        if start is None or now is None or dist(start.pixel, now.pixel) < STILL:
            return
        match self._doing:
            case DragKind.CATCHING:
                self._draw_band(surface, start, now)
            case DragKind.MOVING:
                self._draw_moved(surface, pen, now)
            case DragKind.TURNING if self._held:
                self._draw_turned(surface, pen, now)
            case DragKind.RESIZING if body and self._handle:
                self._draw_resized(surface, pen, body, self._handle, now)

    @staticmethod
    def _draw_band(surface: pygame.Surface, start: MousePosition, now: MousePosition) -> None:
        (x, y), (a, b) = start.pixel, now.pixel
        band = pygame.Rect(min(x, a), min(y, b), abs(x - a), abs(y - b))
        pygame.draw.rect(surface, theme.ACCENT, band, 1)

    def _draw_moved(self, surface: pygame.Surface, pen: Pen, now: MousePosition) -> None:
        dx, dy = self._way.point
        bodies = [self._bench.sketch.bodies[name] for name in self._moved]
        outlines = [(body.corners, body.outline.closed) for body in bodies[:CROWD]]
        if len(bodies) > CROWD:
            outlines = [(_frame(bodies), True)]
        for corners, closed in outlines:
            moved = [(x + dx, y + dy) for x, y in corners]
            shape_preview.outline(surface, self._bench.camera, moved, closed=closed)
        message = (
            f"Δx {shape_preview.metres(dx)}  Δy {shape_preview.metres(dy)}  {self._way.snapped_to}"
        )
        shape_preview.write_measure(surface, pen, now.pixel, message.strip())

    def _draw_turned(self, surface: pygame.Surface, pen: Pen, now: MousePosition) -> None:
        handle, turn = self._held, self._turn
        center = complex(*selection_handles.middle(handle))
        for body in handle[:CROWD]:
            place = center + (complex(*body.position) - center) * rect(1, turn)
            corners = body.outline.placed((place.real, place.imag), body.angle + turn)
            shape_preview.outline(surface, self._bench.camera, corners, closed=body.outline.closed)
        shown = degrees((self._angle + turn + pi) % (2 * pi) - pi)
        shape_preview.write_measure(surface, pen, now.pixel, f"{number(shown, 4)}°")

    def _draw_resized(
        self,
        surface: pygame.Surface,
        pen: Pen,
        body: DrawableBody,
        handle: Handle,
        now: MousePosition,
    ) -> None:
        local = selection_handles.dragged(body, handle.index, now.point)
        corners = [selection_handles.to_plane(body, point) for point in local]
        shape_preview.outline(surface, self._bench.camera, corners, closed=body.outline.closed)
        xs, ys = zip(*local, strict=True)
        width, height = max(xs) - min(xs), max(ys) - min(ys)
        message = f"{shape_preview.metres(width)} × {shape_preview.metres(height)}"
        if body.outline.radius is not None:
            message = f"r {shape_preview.metres(width / 2)}"
        shape_preview.write_measure(surface, pen, now.pixel, message)


def _turning(bodies: Sequence[DrawableBody], angle: float) -> Proposed[str]:
    names, middle = [body.outline.name for body in bodies], selection_handles.middle(bodies)
    return Proposed(
        partial(moving_and_aligning.turn, names=names, angle=angle, about=middle), names
    )


def _resizing(body: DrawableBody, handle: Handle, to: XY) -> Proposed[str]:
    name = body.outline.name
    return Proposed(partial(drag_handle, name=name, index=handle.index, to=to), [name])


def _frame(bodies: Sequence[DrawableBody]) -> list[XY]:
    """Return the corners of the bounding box of the positions of bodies [m]."""
    xs, ys = zip(*(body.position for body in bodies), strict=True)
    return [(min(xs), min(ys)), (max(xs), min(ys)), (max(xs), max(ys)), (min(xs), max(ys))]
