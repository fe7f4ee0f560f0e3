"""The visible part of the graphs, and its changes by mouse and buttons."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import pygame

from sandbox.app.widgets.plot import Scale

Interval = tuple[float, float]

NOTCH = 0.8
"""The factor by which a notch of the wheel, or a button, scales the visible range."""
SHIFT = 0.25
"""The share of the visible range by which a button moves it."""
CLOSEST = 1e-9
"""The smallest visible range, as a share of the whole."""
CLICK = 5  # px, the least size of a box, and of a side that does not span the whole graph
TWICE = 500  # ms, the largest time between the presses of a double click


class Graph(NamedTuple):
    """A graph in the picture of all of them."""

    unit: str
    """The unit of the quantities that it shows."""
    place: pygame.Rect
    """Its place in the picture [px]."""
    across: Scale
    """Its horizontal axis, with pixels relative to its corner."""
    up: Scale
    """Its vertical axis, with pixels relative to its corner."""


@dataclass(frozen=True, slots=True)
class Zoom:
    """The visible part of the graphs: an interval of each axis, or the whole."""

    across: Interval | None = None
    """The interval of the shared horizontal axis."""
    up: Mapping[str, Interval] = field(default_factory=dict)
    """The intervals of the vertical axes, by unit."""

    def __bool__(self) -> bool:
        return self.across is not None or bool(self.up)

    def visible_scale(self, scale: Scale, unit: str | None = None) -> Scale:
        """Return a scale with the visible interval; without a unit, that of the shared axis."""
        interval = self.across if unit is None else self.up.get(unit)
        return scale if interval is None else scale._replace(low=interval[0], high=interval[1])

    def with_interval(self, interval: Interval) -> "Zoom":
        """Return the zoom with another interval of the shared axis."""
        return replace(self, across=interval)

    def with_vertical_interval(self, unit: str, interval: Interval) -> "Zoom":
        """Return the zoom with another interval of a unit's axis."""
        return replace(self, up={**self.up, unit: interval})


WHOLE = Zoom()


def scaled_about(scale: Scale, value: float, factor: float) -> Interval:
    """Return an axis' interval scaled about a fixed value."""
    return value - (value - scale.low) * factor, value + (scale.high - value) * factor


def shifted_by(scale: Scale, by: float) -> Interval:
    """Return an axis' interval shifted by a value."""
    return scale.low + by, scale.high + by


class Zooming:
    """The mouse over the graphs, which marks a box or moves the visible part; the wheel zooms."""

    def __init__(self, zoom: Zoom) -> None:
        self.zoom = zoom
        """The visible intervals."""
        self.graphs: Sequence[Graph] = ()
        """The graphs as last drawn."""
        self.box: pygame.Rect | None = None
        """The box being marked, in the picture [px]; None if there is none."""
        self.clicked: float | None = None
        """The horizontal value that was clicked on; None if the last release was no click."""
        self._at: tuple[int, int] | None = None  # px, the position of the press
        self._on: Graph | None = None  # the graph there, as it was at the press
        self._panning = False
        self._last = -TWICE  # ms, the time of the last press

    def _under(self, pixel: tuple[int, int]) -> Graph | None:
        return next((each for each in self.graphs if each.place.collidepoint(pixel)), None)

    def press(self, pixel: tuple[int, int], button: int, *, shifted: bool) -> bool:
        """Start marking a box or moving the visible part; return whether a graph is there."""
        graph = self._under(pixel)
        if graph is None or button not in (1, 2, 3):
            return False
        now = pygame.time.get_ticks()
        if button == 1 and now - self._last < TWICE and self._at == pixel:
            self.zoom, self._last, self._on = WHOLE, -TWICE, None
            return True
        self._last, self._at, self._on = now, pixel, graph
        self._before, self._panning = self.zoom, button != 1 or shifted
        return True

    def move(self, pixel: tuple[int, int]) -> bool:
        """Follow the mouse, and return whether a button is held over a graph."""
        if self._on is None or self._at is None:
            return False
        dx, dy = pixel[0] - self._at[0], pixel[1] - self._at[1]
        graph = self._on
        if self._panning:
            sides, rises = graph.across, graph.up
            across = shifted_by(sides, sides.value(0) - sides.value(dx))
            self.zoom = self._before.with_interval(across)
            if abs(dy) >= CLICK:
                up = shifted_by(rises, rises.value(0) - rises.value(dy))
                self.zoom = self.zoom.with_vertical_interval(graph.unit, up)
        elif max(abs(dx), abs(dy)) >= CLICK:
            self.box = self._marked(graph, dx, dy)
        return True

    def _marked(self, graph: Graph, dx: int, dy: int) -> pygame.Rect:
        """Return the box from the position of the press; a thin one spans the whole graph."""
        assert self._at is not None
        box = pygame.Rect(*self._at, dx, dy)
        box.normalize()
        left, right = round(graph.across.start), round(graph.across.end)
        low, high = round(graph.up.start), round(graph.up.end)
        field = pygame.Rect(left, high, right - left, low - high).move(graph.place.topleft)
        if box.height < CLICK:
            box.y, box.height = field.y, field.height
        elif box.width < CLICK:
            box.x, box.width = field.x, field.width
        return box.clip(field)

    def release(self) -> bool:
        """Zoom to the marked box, and return whether a button was held over a graph."""
        graph, box, self.box, self._on = self._on, self.box, None, None
        self.clicked = None
        if graph is None:
            return False
        if box is None and not self._panning and self._at is not None:
            self.clicked = graph.across.value(self._at[0] - graph.place.x)
        if box is not None and box.width and box.height:
            local = box.move(-graph.place.x, -graph.place.y)
            across, up = graph.across, graph.up
            self._show(graph, "across", (across.value(local.left), across.value(local.right)))
            if local.height < round(up.start) - round(up.end):
                self._show(graph, "up", (up.value(local.bottom), up.value(local.top)))
        return True

    def wheel(self, notches: float, pixel: tuple[int, int], *, shifted: bool) -> bool:
        """Zoom about the mouse, vertically with Shift; return whether it is over a graph."""
        graph = self._under(pixel)
        if graph is None:
            return False
        factor = NOTCH**notches
        if shifted:
            value = graph.up.value(pixel[1] - graph.place.y)
            self._show(graph, "up", scaled_about(graph.up, value, factor))
        else:
            value = graph.across.value(pixel[0] - graph.place.x)
            self._show(graph, "across", scaled_about(graph.across, value, factor))
        return True

    def step(self, factor: float = 1.0, shift: float = 0.0) -> None:
        """Zoom the shared axis about its middle, or shift it by a share of the visible interval."""
        if self.graphs:
            scale = self.graphs[0].across
            middle, spread = (scale.low + scale.high) / 2, scale.high - scale.low
            low, high = scaled_about(scale, middle, factor)
            interval = low + shift * spread, high + shift * spread
            self._show(self.graphs[0], "across", interval)

    def _show(self, graph: Graph, axis: str, interval: Interval) -> None:
        """Show an interval of an axis, unless it is too short for floating-point numbers."""
        low, high = interval
        if high - low <= CLOSEST * max(abs(low), abs(high), 1e-300):
            return
        if axis == "across":
            self.zoom = self.zoom.with_interval(interval)
        else:
            self.zoom = self.zoom.with_vertical_interval(graph.unit, interval)
