"""The free-body diagram, and the force polygon."""

from collections.abc import Iterator, Sequence
from math import atan2, copysign, cos, hypot, pi, sin

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing import forces_on_selected_body
from sandbox.app.stage.label_placement import Labels
from sandbox.app.words.language import say
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import AppliedForce, FreeBody

FREE, CLOSE = (24, 26), (12, 14)  # px, the margins beside and above arrows, with and without labels
SHORTEST = 6.0  # px, the least length of an arrow with a label
WIDTH = 3.0  # px
APART = 7.0  # px, between arrows that would overlap
FURTHER = range(16, 45, 14)  # px, the distances of labels from their arrow
SIMILAR = 0.12  # rad, the largest angle between directions that look alike
FLAT = 0.04
"""The arrows of a force polygon are separated if its width is below this share of its length."""


def free_body(pen: Pen, size: tuple[int, int], found: FreeBody) -> pygame.Surface:
    """Draw all forces and the net force from one point, each with its name and size."""
    surface, texts = _sheet(size), forces_on_selected_body.texts(found)
    forces = [acting for acting, _ in texts]
    vectors = [(acting.force[0], -acting.force[1]) for acting in forces]
    low_x, high_x, low_y, high_y = _extent([(0.0, 0.0), *vectors])
    scale = _scale(size, (pen.px(FREE[0]), pen.px(FREE[1])), high_x - low_x, high_y - low_y)
    middle = size[0] / 2, size[1] / 2
    center = middle[0] - scale * (low_x + high_x) / 2, middle[1] - scale * (low_y + high_y) / 2
    labels, ends = Labels(surface.get_rect()), []
    for place, ((acting, text), (x, y)) in enumerate(zip(texts, vectors, strict=True)):
        off = APART * _before(vectors, place)
        turn = atan2(y, x)
        start = center[0] - off * sin(turn), center[1] + off * cos(turn)
        end = start[0] + x * scale, start[1] + y * scale
        lines.arrow(surface, forces_on_selected_body.color(acting), start, end, WIDTH)
        for covered in _along(start, end):
            labels.occupy(covered)
        ends.append((text, forces_on_selected_body.color(acting), start, end))
    pygame.draw.aacircle(surface, theme.TEXT, center, 5)
    labels.occupy(pygame.Rect(center[0] - 7, center[1] - 7, 14, 14))
    for text, color, start, end in ends:
        if hypot(end[0] - start[0], end[1] - start[1]) >= SHORTEST:
            _place_label(surface, pen.write(text, 12, color), color, labels, start, end)
    return surface


def polygon(pen: Pen, size: tuple[int, int], found: FreeBody) -> pygame.Surface:
    """Draw the forces tip to tail, and their sum from the first tail.

    Forces along one line are drawn side by side, since they would cover each other.
    """
    surface, forces = _sheet(size), forces_on_selected_body.not_negligible(found)
    corners = [(0.0, 0.0)]
    for acting in forces:
        x, y = corners[-1]
        corners.append((x + acting.force[0], y - acting.force[1]))
    low_x, high_x, low_y, high_y = _extent(corners)
    aside = _separation_direction(forces)
    spread = APART * len(forces) if aside else 0.0
    free = CLOSE[0] + spread / 2, CLOSE[1] + spread / 2
    scale = _scale(size, free, high_x - low_x, high_y - low_y)
    x0 = size[0] / 2 - scale * (low_x + high_x) / 2
    y0 = size[1] / 2 - scale * (low_y + high_y) / 2
    dx, dy = aside or (0.0, 0.0)

    def pixel(corner: int, row: int) -> XY:
        x, y = corners[corner]
        by = APART * (row - len(forces) / 2)
        return x0 + x * scale + dx * by, y0 + y * scale + dy * by

    for i, acting in enumerate(forces):
        lines.arrow(
            surface, forces_on_selected_body.color(acting), pixel(i, i), pixel(i + 1, i), WIDTH
        )
        if aside and i:
            lines.dashed(surface, theme.AXIS, (pixel(i, i - 1), pixel(i, i)), 2, 2)
    last = len(forces)
    start, end = pixel(0, last if aside else 0), pixel(last, last if aside else 0)
    net = hypot(*forces_on_selected_body.without_rounding(found.net, found))
    if net:
        lines.arrow(surface, theme.RESULTANT, start, end, WIDTH + 1)
    message = say("sum {force} N", force=forces_on_selected_body.newtons(net))
    surface.blit(pen.write(message, 12, theme.RESULTANT), (4, 2))
    return surface


def _sheet(size: tuple[int, int]) -> pygame.Surface:
    surface = pygame.Surface(size)
    surface.fill(theme.STAGE)
    return surface


def _extent(points: Sequence[XY]) -> tuple[float, float, float, float]:
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(xs), max(xs), min(ys), max(ys)


def _scale(size: XY, free: XY, width: float, height: float) -> float:
    """Return the scale at which all forces fit [px/N]."""
    rooms = ((size[0] - 2 * free[0], width), (size[1] - 2 * free[1], height))
    return min((max(room, 10.0) / extent for room, extent in rooms if extent), default=0.0)


def _before(vectors: Sequence[XY], place: int) -> int:
    """Return the number of earlier arrows with a similar direction."""
    own = atan2(vectors[place][1], vectors[place][0])
    turns = (atan2(y, x) - own for x, y in vectors[:place] if (x, y) != (0.0, 0.0))
    return sum(abs((turn + pi) % (2 * pi) - pi) < SIMILAR for turn in turns)


def _separation_direction(forces: Sequence[AppliedForce]) -> XY | None:
    """Return the direction in which arrows along one line are separated; None if they are not."""
    longest = max(forces, key=lambda acting: acting.magnitude, default=None)
    if longest is None or len(forces) < 2 or not longest.magnitude:
        return None
    x, y = longest.force[0] / longest.magnitude, longest.force[1] / longest.magnitude
    widest = max(abs(x * a.force[1] - y * a.force[0]) for a in forces)
    return (y, x) if widest < FLAT * longest.magnitude else None


def _along(start: XY, end: XY) -> Iterator[pygame.Rect]:
    """Yield the places along an arrow that labels should keep free [px]."""
    steps = max(int(hypot(end[0] - start[0], end[1] - start[1]) / 8), 1)
    for i in range(steps + 1):
        x, y = (a + (b - a) * i / steps for a, b in zip(start, end, strict=True))
        yield pygame.Rect(round(x) - 4, round(y) - 4, 8, 8)


def _place_label(
    surface: pygame.Surface, image: pygame.Surface, color: Color, labels: Labels, start: XY,
    end: XY,
) -> None:  # fmt: skip
    """Place a label near a tip: beyond it, at its sides, or further back along the arrow.

    If these places are taken, a thin line leads to a label further off.
    """
    length = hypot(end[0] - start[0], end[1] - start[1])
    ux, uy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    half, high = image.width / 2 + 8, image.height / 2 + 6
    places = [(end[0] + ux * half, end[1] + uy * high), (end[0], end[1] + copysign(high, uy))]
    for back in (0.0, 0.3, 0.6):
        x, y = end[0] - ux * length * back, end[1] - uy * length * back
        places += [(x + copysign(half, ux), y), (x - copysign(half, ux), y)]
        places += [(x, y - image.height), (x, y + image.height)]
    bounds = surface.get_rect()
    rects = (image.get_rect(center=place).clamp(bounds) for place in places)
    if found := labels.place_for(rects):
        surface.blit(image, found)
        return
    for x, y, place in _places_off_arrow(image, start, end):
        if found := labels.place_for([place.clamp(bounds)]):
            nearest = min(max(x, found.left), found.right), min(max(y, found.top), found.bottom)
            pygame.draw.aaline(surface, color, (x, y), nearest)
            surface.blit(image, found)
            return


def _places_off_arrow(
    image: pygame.Surface, start: XY, end: XY
) -> Iterator[tuple[float, float, pygame.Rect]]:
    """Yield points of an arrow, each with a place further off, the nearest first [px]."""
    for off in FURTHER:
        for back in (0.05, 0.3, 0.6):
            x, y = (b + (a - b) * back for a, b in zip(start, end, strict=True))
            for across, up in ((1, 0), (-1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)):
                aside = across * (image.width / 2 + off)
                yield x, y, image.get_rect(center=(x + aside, y - up * image.height * 1.1))
