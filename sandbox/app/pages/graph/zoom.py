"""The visible part of the graphs, and how mouse and buttons change it."""

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
CLICK = 5  # px; a box that is smaller is none, and one that is lower or narrower spans all
TWICE = 500  # ms, between the two presses of a double click


class Graph(NamedTuple):
    """A graph in the picture of all of them.

    Attributes
    ----------
    unit
        The unit of the quantities that it shows.
    place
        Its place in the picture [px].
    across, up
        Its axes, with pixels from its own corner.
    """

    unit: str
    place: pygame.Rect
    across: Scale
    up: Scale


@dataclass(frozen=True, slots=True)
class Zoom:
    """The visible part of the graphs: an interval along each axis, or all of it.

    Attributes
    ----------
    across
        The interval of the axis that all graphs share.
    up
        Those of the others, by unit.
    """

    across: Interval | None = None
    up: Mapping[str, Interval] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return self.across is not None or bool(self.up)

    def on(self, scale: Scale, unit: str | None = None) -> Scale:
        """Return the visible interval of a scale; without a unit, of the shared axis."""
        interval = self.across if unit is None else self.up.get(unit)
        return scale if interval is None else scale._replace(low=interval[0], high=interval[1])

    def along(self, interval: Interval) -> "Zoom":
        """Look at another interval of the shared axis."""
        return replace(self, across=interval)

    def upwards(self, unit: str, interval: Interval) -> "Zoom":
        """Look at another interval of a unit's axis."""
        return replace(self, up={**self.up, unit: interval})


WHOLE = Zoom()


def about(scale: Scale, value: float, factor: float) -> Interval:
    """Scale an axis' interval about a value that stays in place."""
    return value - (value - scale.low) * factor, value + (scale.high - value) * factor


def moved(scale: Scale, by: float) -> Interval:
    """Return as much of an axis further on."""
    return scale.low + by, scale.high + by


class Zooming:
    """The mouse over the graphs: it drags a box, or what is seen; the wheel zooms.

    Attributes
    ----------
    zoom
        The visible intervals.
    graphs
        The graphs as they were drawn last.
    box
        The part being marked, in the picture [px]; None if there is none.
    clicked
        The value across that was clicked on last; None if the button was let go of elsewhere.
    """

    def __init__(self, zoom: Zoom) -> None:
        self.zoom = zoom
        self.graphs: Sequence[Graph] = ()
        self.box: pygame.Rect | None = None
        self.clicked: float | None = None
        self._at: tuple[int, int] | None = None  # px, where a button was pressed
        self._on: Graph | None = None  # the graph there, as it was then
        self._panning = False
        self._last = -TWICE  # ms, when one was pressed before

    def _under(self, pixel: tuple[int, int]) -> Graph | None:
        return next((each for each in self.graphs if each.place.collidepoint(pixel)), None)

    def press(self, pixel: tuple[int, int], button: int, *, shifted: bool) -> bool:
        """Begin to mark a box or to move what is seen; return whether a graph is there."""
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
        """Follow the mouse; return whether it marks or moves anything."""
        if self._on is None or self._at is None:
            return False
        dx, dy = pixel[0] - self._at[0], pixel[1] - self._at[1]
        graph = self._on
        if self._panning:
            sides, rises = graph.across, graph.up
            across = moved(sides, sides.value(0) - sides.value(dx))
            self.zoom = self._before.along(across)
            if abs(dy) >= CLICK:
                up = moved(rises, rises.value(0) - rises.value(dy))
                self.zoom = self.zoom.upwards(graph.unit, up)
        elif max(abs(dx), abs(dy)) >= CLICK:
            self.box = self._marked(graph, dx, dy)
        return True

    def _marked(self, graph: Graph, dx: int, dy: int) -> pygame.Rect:
        """Return the box from where the button was pressed; a thin one spans the whole graph."""
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
        """Zoom to the marked part; return whether a button was held over a graph."""
        graph, box, self.box, self._on = self._on, self.box, None, None
        self.clicked = None
        if graph is None:
            return False
        if box is None and not self._panning and self._at is not None:
            self.clicked = graph.across.value(self._at[0] - graph.place.x)
        if box is not None and box.width and box.height:
            local = box.move(-graph.place.x, -graph.place.y)
            across, up = graph.across, graph.up
            self._look(graph, "across", (across.value(local.left), across.value(local.right)))
            if local.height < round(up.start) - round(up.end):
                self._look(graph, "up", (up.value(local.bottom), up.value(local.top)))
        return True

    def wheel(self, notches: float, pixel: tuple[int, int], *, shifted: bool) -> bool:
        """Zoom about the mouse, upwards with Shift; return whether it is over a graph."""
        graph = self._under(pixel)
        if graph is None:
            return False
        factor = NOTCH**notches
        if shifted:
            value = graph.up.value(pixel[1] - graph.place.y)
            self._look(graph, "up", about(graph.up, value, factor))
        else:
            value = graph.across.value(pixel[0] - graph.place.x)
            self._look(graph, "across", about(graph.across, value, factor))
        return True

    def step(self, factor: float = 1.0, shift: float = 0.0) -> None:
        """Zoom about the middle, or shift by a part of what is visible, along the shared axis."""
        if self.graphs:
            scale = self.graphs[0].across
            middle, spread = (scale.low + scale.high) / 2, scale.high - scale.low
            low, high = about(scale, middle, factor)
            interval = low + shift * spread, high + shift * spread
            self._look(self.graphs[0], "across", interval)

    def _look(self, graph: Graph, axis: str, interval: Interval) -> None:
        """Look at an interval of an axis, unless that is too short for its numbers."""
        low, high = interval
        if high - low <= CLOSEST * max(abs(low), abs(high), 1e-300):
            return
        if axis == "across":
            self.zoom = self.zoom.along(interval)
        else:
            self.zoom = self.zoom.upwards(graph.unit, interval)
