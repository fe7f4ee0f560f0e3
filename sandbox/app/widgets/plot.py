"""Draws lines over numbered axes, for all graphs."""

from collections.abc import Callable, Iterator, Sequence
from math import ceil, degrees, floor
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.drawing import line_styles, lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.words import formatting
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY

LEFT, BELOW, ABOVE, RIGHT = 46, 18, 8, 10  # px, around the field
ROUNDING = 1e-12
"""Smaller differences are rounding: such a line is drawn level, in any unit."""
EQUAL = 1e-9
"""The same, relative to the values."""
MANY = 600
"""The approximate number of points of a line that are drawn: there are no more pixels."""


SIGNED = 4
"""The number of markers on a line; those of different lines are shifted against each other."""
GAP = 7  # px, between the numbers of two ticks
DOT = 2.5  # px, the radius of a marked point
CORNERS = "topleft", "bottomleft", "topright", "bottomright"
MARGIN = 3  # px, around the field, for points on its edge


class Series(NamedTuple):
    """A line: its colour, its points, whether it is dashed, and whether its points are marked.

    `marker` is the index of a marker that distinguishes the line from others, or None.
    """

    color: Color
    x: Array
    y: Array
    dashed: bool = False
    marked: bool = False
    marker: int | None = None


class Scale(NamedTuple):
    """The mapping between the numbers and the pixels of an axis."""

    low: float
    high: float
    start: float
    end: float

    def pixels(self, values: Array) -> Array:
        """Return the positions of values [px]."""
        share = (values - self.low) / (self.high - self.low)
        return np.asarray(self.start + share * (self.end - self.start))

    def value(self, pixel: float) -> float:
        """Return the value at a pixel."""
        share = (pixel - self.start) / (self.end - self.start)
        return self.low + share * (self.high - self.low)

    def in_shown_unit(self, unit: str) -> "Scale":
        """Return the scale with the numbers to show for a unit: radians in degrees."""
        if not unit.startswith("rad"):
            return self
        return self._replace(low=degrees(self.low), high=degrees(self.high))

    def ticks(self, most: int) -> Iterator[float]:
        """Yield round numbers along the axis, between about `most` and 2.5 times that many."""
        step = formatting.nice((self.high - self.low) / most)
        for i in range(ceil(self.low / step), floor(self.high / step) + 1):
            yield i * step


def scale(
    values: Sequence[Array], start: float, end: float, room: float, equal: float = EQUAL
) -> Scale:
    """Return the scale for some values, with a fraction `room` of it left free at both ends.

    Values whose relative differences are at most `equal` are drawn level.
    """
    finite = [v[np.isfinite(v)] for v in values]
    numbers = np.concatenate(finite) if finite else np.zeros(0)
    low, high = (float(numbers.min()), float(numbers.max())) if len(numbers) else (0.0, 1.0)
    least = max(equal * max(abs(low), abs(high)), ROUNDING)
    spread = high - low if high - low > least else max(abs(high), 1.0)
    middle = (low + high) / 2
    half = spread * (0.5 + room)
    return Scale(middle - half, middle + half, start, end)


def draw(
    pen: Pen, size: tuple[int, int], series: Sequence[Series], span: Scale, cursor: float | None,
    up: Scale | None = None, units: tuple[str, str] = ("", ""),
) -> pygame.Surface:  # fmt: skip
    """Draw a graph of lines, the last on top.

    The cursor is a value of x. By default the scale of y has room for all lines. The units are
    those of x and y; radians are shown in degrees.
    """
    surface = pygame.Surface(size)
    surface.fill(theme.STAGE)
    up = up or vertical_scale(pen, size[1], [each.y for each in series])
    if series:  # otherwise the scale of y means nothing
        _draw_heights(surface, pen, span, up.in_shown_unit(units[1]))
    _draw_widths(surface, pen, span.in_shown_unit(units[0]), up)
    field = pygame.Rect(round(span.start), round(up.end), 0, 0)
    field.size = round(span.end - span.start), round(up.start - up.end)
    surface.set_clip(field.inflate(2 * MARGIN, 2 * MARGIN))
    for each in series:
        _draw_line(surface, each, span, up)
    _write_offset(surface, pen, field, series, span, up)
    if cursor is not None:
        x = round(float(span.pixels(np.array(cursor))))
        pygame.draw.line(surface, theme.NOTICE, (x, up.end), (x, up.start))
    surface.set_clip(None)
    return surface


def horizontal_scale(pen: Pen, width: int, values: Sequence[Array]) -> Scale:
    """Return the scale of x for a graph of some width [px]."""
    return scale(values, pen.px(LEFT), width - pen.px(RIGHT), 0.0)


def vertical_scale(pen: Pen, height: int, values: Sequence[Array], equal: float = EQUAL) -> Scale:
    """Return the scale of y for a graph of some height [px], with a little room at both ends.

    Values whose relative differences are at most `equal` are drawn level.
    """
    return scale(values, height - pen.px(BELOW), pen.px(ABOVE), 0.06, equal)


def _draw_line(surface: pygame.Surface, series: Series, span: Scale, up: Scale) -> None:
    """Draw the parts of a line in the field."""
    field = np.array([[span.start, up.end], [span.end, up.start]])
    pixels = np.column_stack((span.pixels(series.x), up.pixels(series.y)))
    for part in _parts(pixels[np.isfinite(pixels).all(axis=1)], field):
        every = max(len(part) // MANY, 1)
        indices = np.append(np.arange(0, len(part) - 1, every), len(part) - 1)
        _draw_part(surface, series, [(x, y) for x, y in part[indices].tolist()])


def _parts(pixels: Array, field: Array) -> Iterator[Array]:
    """Yield the parts of a polyline, (k, 2), near a field, given by its two corners [px]."""
    if len(pixels) < 2:
        yield from (pixels,) if len(pixels) else ()
        return
    before, after = pixels[:-1], pixels[1:]
    least, most = np.minimum(before, after), np.maximum(before, after)
    near = ((most >= field[0] - MARGIN) & (least <= field[1] + MARGIN)).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], near, [False]))))
    for start, end in edges.reshape(-1, 2).tolist():
        yield pixels[start : end + 1]


def _draw_part(surface: pygame.Surface, series: Series, points: Sequence[XY]) -> None:
    if series.marked:
        for point in points:
            pygame.draw.aacircle(surface, series.color, point, DOT)
    if series.marker is not None and points and lines.are_close(points):
        _sign(surface, series.marker, series.color, points)
    if len(points) < 2:
        return
    if series.dashed:
        lines.dashed(surface, series.color, points)
    elif lines.are_close(points):
        pygame.draw.aalines(surface, series.color, False, points)
    else:
        lines.path(surface, series.color, points, 1)


def _sign(surface: pygame.Surface, which: int, color: Color, points: Sequence[XY]) -> None:
    """Draw markers at equal distances along a line's points."""
    count = SIGNED * line_styles.SIGNS
    for place in range(which % line_styles.SIGNS, count, line_styles.SIGNS):
        line_styles.marker(surface, which, color, points[len(points) * place // count], 3)


def _draw_heights(surface: pygame.Surface, pen: Pen, span: Scale, up: Scale) -> None:
    """Draw lines at round values of y, and the values."""
    left, offset = round(span.start), _offset(up)
    beyond = Scale(up.low - offset, up.high - offset, up.start, up.end)
    for value in _ticks_apart(beyond, lambda text: pen.write(text, 11).height, 0):
        y = round(float(beyond.pixels(np.array(value))))
        pygame.draw.line(surface, theme.GRID_STRONG, (left, y), (span.end, y))
        text = pen.write(_brief(value), 11, theme.DIM)
        surface.blit(text, text.get_rect(midright=(left - 4, y)))


def _draw_widths(surface: pygame.Surface, pen: Pen, span: Scale, up: Scale) -> None:
    """Draw lines at round values of x, and the values."""
    bottom = round(up.start)
    for value in _ticks_apart(span, lambda text: pen.write(text, 11).width, pen.px(GAP)):
        x = round(float(span.pixels(np.array(value))))
        pygame.draw.line(surface, theme.GRID_STRONG, (x, up.end), (x, bottom))
        text = pen.write(_brief(value), 11, theme.DIM)
        place = text.get_rect(midtop=(x, bottom + 3)).clamp(surface.get_rect())
        surface.blit(text, place)


def _write_offset(
    surface: pygame.Surface, pen: Pen, field: pygame.Rect, series: Sequence[Series], span: Scale,
    up: Scale,
) -> None:  # fmt: skip
    """Write the offset of the numbers on the y axis, in a corner that no line crosses."""
    if not (offset := _offset(up)):
        return
    text = pen.write(f"{_brief(offset)} + …", 11, theme.NOTICE)
    place, inside = text.get_rect(), field.inflate(-2 * GAP, 0)
    corners = [place.move_to(**{corner: getattr(inside, corner)}) for corner in CORNERS]
    pixels = [np.column_stack((span.pixels(each.x), up.pixels(each.y))) for each in series]

    def free(place: pygame.Rect) -> bool:
        box = np.array([place.topleft, place.bottomright])
        return not any(any(True for _ in _parts(line, box)) for line in pixels)

    surface.blit(text, next(filter(free, corners), corners[0]))


def _ticks_apart(span: Scale, size: Callable[[str], int], gap: int) -> Sequence[float]:
    """Return the ticks of an axis, as many as there is room for their numbers."""
    for most in (4, 2, 1):
        ticks = [*span.ticks(most)]
        largest = max((size(_brief(value)) for value in ticks), default=0)
        apart = abs(span.end - span.start) * (ticks[1] - ticks[0] if len(ticks) > 1 else 1.0)
        if len(ticks) < 2 or apart / (span.high - span.low) > largest + gap:
            break
    return ticks


def _offset(up: Scale) -> float:
    """Return the offset that is subtracted from nearly equal numbers; else 0."""
    middle = (up.low + up.high) / 2
    return middle if up.high - up.low < 1e-3 * abs(middle) else 0.0


def _brief(value: float) -> str:
    """Format the number of a tick."""
    return formatting.brief(0.0 if abs(value) < 1e-15 else value)
