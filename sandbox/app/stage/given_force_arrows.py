"""Draws given forces as arrows, added tip to tail; their tips can be dragged."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import copysign, hypot
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.stage.label_placement import Labels
from sandbox.app.words.formatting import MINUS, number
from sandbox.app.words.language import say
from sandbox.model.effects.force import Force
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.rules.level_validation import corners
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World

LONGEST = 0.18
"""The longest arrow at the parameters' defaults, as a fraction of the stage's width."""

LONGER = 3.0
"""How many times as long as at the defaults arrows may become within the parameters' ranges."""

WIDTH = 4.0  # px, thicker than the arrow of a velocity, which may overlap
HANDLE = 5.0  # px, the radius of the ring at a tip that can be dragged
REACH = 11.0  # px, the distance within which the mouse grabs a tip
STEEP = 0.2  # arrows with a smaller horizontal share are steep: their text goes beyond the tip
AROUND = (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)
"""The directions in which a text is placed from a point, to the right and downwards."""
FURTHER = range(25, 110, 20)  # px, the distances of texts that a thin line leads to
LEADER = 30  # px, twice the distance from its arrow beyond which a text gets a leader line
INSTANTS = 240
"""The number of times at which a force is evaluated to find its largest value."""


@dataclass(frozen=True, slots=True)
class Arrow:
    """A force with its point of application."""

    row: int
    """The index of the body."""
    tail: XY
    """The point of application [m]."""
    newtons: XY
    """The components [N]."""
    handles: Mapping[int, str]
    """The parameters that are components of the force, by axis; only these can be dragged."""
    name: str
    """The name of the force, or empty."""

    def tip(self, camera: Camera, scale: float) -> XY:
        """Return the position of the tip [px] at a scale [px/N]."""
        x, y = camera.to_screen(self.tail)
        return x + self.newtons[0] * scale, y - self.newtons[1] * scale

    @property
    def text(self) -> str:
        """The text beside the arrow."""
        if self.name:
            return f"{self.name} {_pair(*self.newtons)}"
        return f"{number(hypot(*self.newtons), 3)} N"


class Forces:
    """The given forces of a level, in the worlds that are built from it."""

    def __init__(self, level: Level) -> None:
        self._forces = level.effects.force or ()
        rows = {name: row for row, name in enumerate(level.bodies)}
        self._rows = [rows[force.body] for force in self._forces]
        self._handles = [_handles(force, level) for force in self._forces]
        self._strongest = _strongest(level, self._forces)

    def scale(self, camera: Camera) -> float:
        """Return the scale of forces [px/N]."""
        return LONGEST * camera.size[0] / self._strongest if self._strongest else 0.0

    def arrows(self, world: World) -> Iterator[Arrow]:
        """Yield the current forces, except those that are switched off."""
        snapshot = world.snapshot
        for force, row, handles in zip(self._forces, self._rows, self._handles, strict=True):
            if not _acts(force, world):
                continue
            turn = complex(np.exp(1j * float(snapshot.angle[row])))
            newtons = complex(*(float(part.over(world.values, snapshot.t)) for part in force.force))
            if force.frame == "body":
                newtons *= turn
            arm = complex(*evaluate(force.at, world.values)) * turn
            px, py = snapshot.position[row].tolist()
            name = _shared(*handles.values()) if len(handles) == 2 else ""
            tail = px + arm.real, py + arm.imag
            yield Arrow(row, tail, (newtons.real, newtons.imag), handles, name)

    def tip_at(self, world: World, camera: Camera, pixel: XY) -> Arrow | None:
        """Return the force whose tip can be dragged at a pixel, or None."""
        scale = self.scale(camera)
        free = [arrow for arrow in self.arrows(world) if arrow.handles and scale]
        tips = ((arrow.tip(camera, scale), arrow) for arrow in reversed(free))
        return next((a for (x, y), a in tips if hypot(x - pixel[0], y - pixel[1]) <= REACH), None)

    def draw(
        self, surface: pygame.Surface, camera: Camera, pen: Pen, world: World, labels: Labels
    ) -> None:
        """Draw the forces, with the resultant of those that act at the same point."""
        scale = self.scale(camera)
        ordered = sorted(self.arrows(world), key=lambda arrow: arrow.row)
        for arrow in ordered:
            labels.mark(camera.to_screen(arrow.tail), arrow.tip(camera, scale))
        for _, group in groupby(ordered, key=lambda arrow: (arrow.row, arrow.tail)):
            arrows = list(group)
            if len(arrows) > 1:
                _draw_sum(surface, camera, pen, arrows, scale, labels)
            for i, arrow in enumerate(arrows):
                color = theme.FORCES[i % len(theme.FORCES)]
                start, end = camera.to_screen(arrow.tail), arrow.tip(camera, scale)
                lines.arrow(surface, color, start, end, WIDTH)
                if arrow.handles and lines.are_close((end,)):
                    pygame.draw.aacircle(surface, theme.TEXT, end, HANDLE, 2)
                name = f"given {arrow.row} {i} {arrow.name}"
                write_beside(surface, pen, arrow.text, start, end, labels, color, name)


def _draw_sum(
    surface: pygame.Surface, camera: Camera, pen: Pen, arrows: list[Arrow], scale: float,
    labels: Labels,
) -> None:  # fmt: skip
    """Draw the forces tip to tail, all but the first dashed, and the resultant."""
    start, at = camera.to_screen(arrows[0].tail), arrows[0].tip(camera, scale)
    for i, arrow in enumerate(arrows[1:], start=1):
        end = at[0] + arrow.newtons[0] * scale, at[1] - arrow.newtons[1] * scale
        color = theme.faded(theme.FORCES[i % len(theme.FORCES)], 0.75)
        lines.dashed(surface, color, (at, end), 6, 4)
        lines.head(surface, color, at, end)
        at = end
    x, y = (sum(arrow.newtons[axis] for arrow in arrows) for axis in (0, 1))
    lines.arrow(surface, theme.RESULTANT, start, at, WIDTH)
    message = say("sum {components}, {size} N", components=_pair(x, y), size=number(hypot(x, y), 3))
    name = f"sum {arrows[0].row} {arrows[0].tail}"
    write_beside(surface, pen, message, start, at, labels, theme.RESULTANT, name)


def _pair(x: float, y: float) -> str:
    return f"({x:.3g}, {y:.3g}) N".replace("-", MINUS)


class ForceLabel(NamedTuple):
    """A text that has its place beside an arrow."""

    image: pygame.Surface
    place: pygame.Rect
    color: Color
    leader: tuple[XY, XY] | None
    """a line that leads to a text further off [px]"""

    def draw_leader(self, surface: pygame.Surface) -> None:
        """Draw the line that leads to the text, if it needs one."""
        if self.leader:
            pygame.draw.aaline(surface, self.color, *self.leader)


def write_beside(
    surface: pygame.Surface, pen: Pen, text: str, start: XY, end: XY, labels: Labels, color: Color,
    name: str,
) -> None:  # fmt: skip
    """Write text beside an arrow; if there is no room, it is left out."""
    if written := beside(surface, pen, text, start, end, labels, color, name):
        written.draw_leader(surface)
        surface.blit(written.image, written.place)


def beside(
    surface: pygame.Surface, pen: Pen, text: str, start: XY, end: XY, labels: Labels, color: Color,
    name: str, avoid: Sequence[pygame.Rect] = (),
) -> ForceLabel | None:  # fmt: skip
    """Return a text beside the tip of an arrow; beyond the tip if the arrow is steep.

    If labels, arrows or areas to avoid are in the way, the text is placed around the tip or along
    the arrow, or further off, with a thin line that leads to it; None if there is no room, or the
    arrow is too short to be seen.
    """
    length = hypot(end[0] - start[0], end[1] - start[1])
    if length < HANDLE or not surface.get_rect().collidepoint(end):
        return None
    image = pen.outlined(text, color=color)
    around = [*_beside(image, start, end, length), *_further_off(image, end)]
    place = labels.place_for([each.clamp(labels.bounds) for each in around], avoid, name=name)
    if place is None:
        return None
    if pygame.FRect(place).inflate(LEADER, LEADER).clipline(start, end):
        return ForceLabel(image, place, color, None)
    near = min(max(end[0], place.left), place.right), min(max(end[1], place.top), place.bottom)
    return ForceLabel(image, place, color, (end, near))


def _beside(image: pygame.Surface, start: XY, end: XY, length: float) -> Iterator[pygame.Rect]:
    """Yield the places of a text at the tip of an arrow, and along it [px]."""
    ux, uy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    aside = copysign(HANDLE + 6 + image.width / 2, ux) if abs(ux) > STEEP else 0.0
    beyond = uy * (6 if aside else HANDLE + 4 + image.height / 2)
    place = image.get_rect(center=(end[0] + aside, end[1] + beyond))
    yield from (place.move(0, off * image.height) for off in (0, -1, 1))
    across, over = image.width / 2 + HANDLE + 6, image.height / 2 + HANDLE + 4
    for back in (0.0, 0.5, 1.0):
        x, y = end[0] - back * ux * length, end[1] - back * uy * length
        beside = image.get_rect(center=(x, y))
        moves = (*AROUND, (0, 2), (0, -2))
        yield from (beside.move(across * right, over * down) for right, down in moves)


def _further_off(image: pygame.Surface, end: XY) -> Iterator[pygame.Rect]:
    """Yield the places of a text further off from the tip of an arrow, the nearest first [px]."""
    beside = image.get_rect(center=end)
    for off in FURTHER:
        across, over = image.width / 2 + off, image.height / 2 + off
        yield from (beside.move(across * right, over * down) for right, down in AROUND)


def _acts(force: Force, world: World) -> bool:
    """Whether a force acts, that is, no event has switched it, or all given forces, off."""
    found = (world.scene.switches.get(name) for name in (force.name or "", force.effect.name))
    return all(switch.at(world.snapshot.t) for switch in found if switch)


def _shared(x: str, y: str) -> str:
    """Return the common prefix of two names: "F1" for "F1x" and "F1y"."""
    same = (i for i, (a, b) in enumerate(zip(x, y, strict=False)) if a != b)
    return x[: next(same, min(len(x), len(y)))]


def _handles(force: Force, level: Level) -> Mapping[int, str]:
    """Return the components, by axis, that are just a parameter; none in the frame of a body."""
    if force.frame == "body":
        return {}
    sources = ((axis, str(part.source).strip()) for axis, part in enumerate(force.force))
    return {axis: source for axis, source in sources if source in level.parameters}


def _strongest(level: Level, forces: tuple[Force, ...]) -> float:
    """Return the force that corresponds to the longest arrow [N]."""
    names = names_in(forces) - {"t"}
    sizes = [_largest(level, forces, values) for values in corners(level, names)] if forces else [0]
    return max(sizes[0], max(sizes) / LONGER)


def _largest(level: Level, forces: tuple[Force, ...], values: Values) -> float:
    """Return the largest magnitude of a force, or of a body's resultant, with some values [N]."""
    t = np.linspace(0.0, level.duration(values), INSTANTS)
    sums: dict[str, Array] = {}
    largest = 0.0
    for force in forces:
        try:
            both = np.stack([part.over(values, t) for part in force.force])
        except ExpressionError:
            continue
        sums[force.body] = sums.get(force.body, 0.0) + both
        for vector in (both, sums[force.body]):
            size = np.hypot(*vector)
            largest = max(largest, float(size[np.isfinite(size)].max(initial=0.0)))
    return largest
