"""Draws the marks that explain a motion: trails, ghosts, velocity arrows, events, names."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, pairwise
from math import copysign, hypot

import numpy as np
import pygame

from sandbox.app.drawing import line_styles, lines, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.events_of_checks import Milestone
from sandbox.app.stage.body_outlines import Outline
from sandbox.app.stage.label_placement import Labels
from sandbox.app.words.formatting import name_in_words, nice, number
from sandbox.app.words.level_translation import Say
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.shapes import XY
from sandbox.physics.stepping.world import World

LONGEST = 0.14
"""The longest arrow, as a fraction of the stage's width."""

LINE, FURTHER = 16, 4
"""The height of a line [px], and the number of offsets by lines at which a label may be placed."""

LARGE = 50
"""The least width and height of a large body [px]."""

GAP = 3
"""The distance of a text from the bodies that cover its point [px]."""

NOWHERE = pygame.Rect(-10_000, -10_000, 0, 0)
"""The place of a name that is not written."""

Placed = tuple[Outline, XY, float]
"""A body with its position [m] and angle [rad]."""

PATH_POINTS = 240
"""The number of points of the closed form's path."""


def trail_color(color: Color) -> Color:
    """Return the colour of the trail of a body of some colour."""
    return theme.faded(color, 0.6)


def draw_trail(surface: pygame.Surface, camera: Camera, color: Color, points: Array) -> None:
    """Draw a body's path through points: (k, 2) [m]."""
    pixels = camera.path(points.tolist())
    steps = [pixels[0]]
    for pixel in pixels[1:]:
        if hypot(pixel[0] - steps[-1][0], pixel[1] - steps[-1][1]) >= 2:
            steps.append(pixel)
    steps.append(pixels[-1])
    lines.path(surface, color, steps, 2)


def draw_ghost(
    surface: pygame.Surface, camera: Camera, outline: Outline, position: XY, angle: float,
    lane: int | None = None,
) -> None:  # fmt: skip
    """Draw a dashed outline of a body, of the closed form or, with a `lane`, of a companion run."""
    color = theme.GHOST if lane is None else theme.LANES[lane]
    corners = camera.path(outline.placed(position, angle))
    if outline.closed:
        corners.append(corners[0])
    lines.dashed(surface, color, corners, *line_styles.dash(lane or 0))
    if lines.are_close(corners):
        x, y = camera.to_screen(position)
        pygame.draw.aacircle(surface, color, (x, y), 2)


def draw_ghost_path(
    surface: pygame.Surface, camera: Camera, formulas: tuple[Formula, Formula],
    values: Values, duration: float,
) -> None:  # fmt: skip
    """Draw the closed form's path over the level's duration."""
    t = np.linspace(0.0, duration, PATH_POINTS)
    where = ghost_positions(formulas, values, t)
    if where is not None:
        draw_ghost_trail(surface, camera, where)


def draw_ghost_trail(surface: pygame.Surface, camera: Camera, points: Array) -> None:
    """Draw a dashed path through points: (k, 2) [m]."""
    color = theme.faded(theme.GHOST, 0.35)
    lines.dashed(surface, color, camera.path(points.tolist()), 3, 6)


def ghost_position(formulas: tuple[Formula, Formula], values: Values, t: float) -> XY | None:
    """Return the closed form's position of a body [m]; None if it is not defined."""
    where = ghost_positions(formulas, values, np.array([t]))
    return None if where is None else (float(where[0, 0]), float(where[0, 1]))


def ghost_positions(formulas: tuple[Formula, Formula], values: Values, t: Array) -> Array | None:
    """Return the closed form's positions at many times, (k, 2) [m]; None if not all defined."""
    try:
        found = np.stack([formula.over(values, t) for formula in formulas], axis=-1)
    except ExpressionError:
        return None
    return found if np.isfinite(found).all() else None


def draw_arrow(
    surface: pygame.Surface, camera: Camera, position: XY, velocity: XY, seconds: float
) -> None:
    """Draw a velocity as the displacement in some time [s]."""
    end = position[0] + velocity[0] * seconds, position[1] + velocity[1] * seconds
    lines.arrow(surface, theme.ARROW, camera.to_screen(position), camera.to_screen(end))


def draw_components(
    surface: pygame.Surface, camera: Camera, pen: Pen, position: XY, velocity: XY, seconds: float
) -> None:  # fmt: skip
    """Draw a velocity's two components, and the rectangle that they span."""
    start = camera.to_screen(position)
    across, up = (velocity[0] * seconds * camera.scale, -velocity[1] * seconds * camera.scale)
    if min(abs(across), abs(up)) < 2 or not lines.are_close((start,)):
        return
    x, y = start
    for color, end in ((theme.ACROSS, (x + across, y)), (theme.UPWARDS, (x, y + up))):
        lines.arrow(surface, color, start, end)
        dim = theme.faded(color, 0.6)
        lines.dashed(surface, dim, (end, (x + across, y + up)), 3, 4)
    along, upright = (
        pen.outlined(f"v{axis} {number(v, 3)} m/s") for axis, v in zip("xy", velocity, strict=True)
    )
    side = x + across + copysign(along.width / 2 + 6, across)
    surface.blit(along, along.get_rect(center=(side, y)))
    surface.blit(upright, upright.get_rect(center=(x, y + up + copysign(12, up))))


def expected_highest_speed(world: World, duration: float) -> float:
    """Return the highest speed at the start or of a ghost [m/s]."""
    velocity = world.snapshot.velocity
    speeds = [float(np.hypot(velocity[:, 0], velocity[:, 1]).max())]
    t = np.linspace(0.0, duration, PATH_POINTS)
    for formulas in world.level.ghosts.values():
        where = ghost_positions(formulas, world.values, t)
        if where is not None:
            steps = np.diff(where, axis=0)
            sizes = np.sort(np.hypot(steps[:, 0], steps[:, 1]))
            # not the largest ones, which may be jumps of the formula
            speeds.append(float(sizes[int(0.95 * (len(sizes) - 1))]) / t[1])
    return max(speeds)


def draw_arrow_key(
    surface: pygame.Surface, camera: Camera, pen: Pen, seconds: float, corner: XY
) -> None:
    """Draw the key to the arrows' length, with its lower right end at a point [px]."""
    speed = nice(70 / (camera.scale * seconds))
    length = speed * seconds * camera.scale
    text = pen.write(f"{speed:g} m/s", 12)
    start = corner[0] - length
    lines.arrow(surface, theme.ARROW, (start, corner[1]), corner)
    surface.blit(text, (corner[0] - max(length, text.width), corner[1] - text.height - 3))


def draw_milestones(
    surface: pygame.Surface, camera: Camera, milestones: Sequence[Milestone], labels: Labels
) -> None:
    """Mark the positions of events."""
    for milestone, (x, y) in _seen(camera, milestones):
        color = theme.PASSED if milestone.passed else theme.FAILED
        corners = [(x, y - 6), (x + 6, y), (x, y + 6), (x - 6, y)]
        lines.fill(surface, theme.STAGE, corners)
        lines.path(surface, color, [*corners, corners[0]], 2)
        labels.occupy(_box(corners))


def write_milestones(
    surface: pygame.Surface, camera: Camera, pen: Pen, milestones: Sequence[Milestone],
    words: Say, labels: Labels, avoid: Sequence[pygame.Rect] = (),
) -> None:  # fmt: skip
    """Write the measured values beside each mark.

    The text avoids some areas if possible [px], such as those of bodies.
    """
    for milestone, (x, y) in _seen(camera, milestones):
        texts = [pen.outlined(text) for text in milestone.texts(words)]
        size = max(t.width for t in texts), sum(t.height - 2 for t in texts)
        around = chain(_around(round(x), round(y), size), _off_bodies(x, y, size, avoid))
        spots, name = (spot.clamp(labels.bounds) for spot in around), f"at {milestone.place}"
        if place := labels.place_for(spots, avoid, name=name):
            top = place.y
            for text in texts:
                surface.blit(text, text.get_rect(midtop=(place.centerx, top)))
                top += text.height - 2


def _seen(camera: Camera, milestones: Sequence[Milestone]) -> Iterator[tuple[Milestone, XY]]:
    """Yield the events near the picture, with their positions in it [px]."""
    for milestone in milestones:
        place = camera.to_screen(milestone.place)
        if lines.are_close((place,)):
            yield milestone, place


def _around(x: int, y: int, size: tuple[int, int]) -> Iterator[pygame.Rect]:
    """Yield places for a text near a point: below, above, beside it, and further away.

    The last places are on one side of the vertical through the point, which may be occupied.
    """
    place = pygame.Rect((0, 0), size)
    for further in range(0, FURTHER * LINE, LINE):
        yield place.move_to(midtop=(x, y + 9 + further))
        yield place.move_to(midbottom=(x, y - 9 - further))
        if not further:
            yield place.move_to(midleft=(x + 11, y))
            yield place.move_to(midright=(x - 11, y))
    for further in range(0, FURTHER * LINE, LINE):  # beside the vertical
        yield place.move_to(topleft=(x + 11, y + 9 + further))
        yield place.move_to(topright=(x - 11, y + 9 + further))
        yield place.move_to(bottomleft=(x + 11, y - 9 - further))
        yield place.move_to(bottomright=(x - 11, y - 9 - further))


def _off_bodies(
    x: float, y: float, size: tuple[int, int], covered: Sequence[pygame.Rect]
) -> Iterator[pygame.Rect]:
    """Yield places for a text around the bodies that cover a point."""
    over = [area for area in covered if area.collidepoint(x, y)]
    if over:
        body, place = over[0].unionall(over[1:]), pygame.Rect((0, 0), size)
        for further in range(GAP, GAP + FURTHER * LINE, LINE):
            yield place.move_to(midtop=(round(x), body.bottom + further))
            yield place.move_to(midbottom=(round(x), body.top - further))
            yield place.move_to(midleft=(body.right + GAP, round(y) + further))
            yield place.move_to(midright=(body.left - GAP, round(y) + further))


def bounding_boxes(camera: Camera, shown: Iterable[Placed]) -> list[pygame.Rect]:
    """Return the bounding boxes of the bodies near the picture [px]."""
    return [_box(path) for path in _paths(camera, shown)]


def mark_large(camera: Camera, shown: Iterable[Placed], labels: Labels) -> None:
    """Mark the sides of large bodies, since a slanted one does not fill its bounding box."""
    for path in _paths(camera, shown):
        if min(_box(path).size) >= LARGE:
            for side in pairwise((*path, path[0])):
                labels.mark(*side)


def _paths(camera: Camera, shown: Iterable[Placed]) -> Iterator[list[XY]]:
    """Yield the outlines of the bodies near the picture [px]."""
    for outline, position, angle in shown:
        path = camera.path(outline.placed(position, angle))
        if lines.are_close(path):
            yield path


def draw_names(
    surface: pygame.Surface, camera: Camera, pen: Pen,
    shown: Sequence[Placed], labels: Labels,
) -> None:  # fmt: skip
    """Write the names of bodies beside them; names without room are left out."""
    paths = [camera.path(outline.placed(position, angle)) for outline, position, angle in shown]
    near = [lines.are_close(path) for path in paths]
    boxes = [_box(path) if seen else pygame.Rect() for path, seen in zip(paths, near, strict=True)]
    for i, (outline, _, _) in enumerate(shown):
        if near[i]:
            text = pen.outlined(name_in_words(outline.name))
            x, y = (round(c) for c in max(paths[i], key=lambda corner: corner[0] - corner[1]))
            box, place = boxes[i], text.get_rect(topleft=(x + 4, y - 16))
            places = [
                place,
                place.move_to(midbottom=(box.centerx, box.top - 1)),
                place.move_to(bottomright=(box.left - 4, box.top + 4)),
                place.move_to(topleft=(box.right + 4, box.bottom - 4)),
                place.move_to(midtop=(box.centerx, box.bottom + 1)),
            ]
            if min(box.size) < LARGE:  # a line further off is still near it
                places += [
                    place.move_to(bottomleft=(box.right + 4, box.top - text.height // 2)),
                    place.move_to(bottomright=(box.left - 4, box.top - text.height // 2)),
                    place.move_to(midbottom=(box.centerx, box.top - text.height)),
                ]
            others, name = boxes[:i] + boxes[i + 1 :], f"name {outline.name}"
            places = [NOWHERE if _is_nearer(each, others, box) else each for each in places]
            if found := labels.place_for(places, others, name=name, strict=True):
                surface.blit(text, found)


def _is_nearer(place: pygame.Rect, others: Sequence[pygame.Rect], own: pygame.Rect) -> bool:
    """Return whether a name at a place would be read as that of another body."""
    across = max(own.left - place.right, place.left - own.right)
    gap = max(across, own.top - place.bottom, place.top - own.bottom, 0)
    beside = place.inflate(2 * gap + 2, 2 * gap + 2).collidelistall(others)
    x, y = place.center
    apart = hypot(own.centerx - x, own.centery - y)
    return any(hypot(others[k].centerx - x, others[k].centery - y) < apart for k in beside)


def _box(corners: Sequence[XY]) -> pygame.Rect:
    """Return the bounding box of some points [px]."""
    (left, top), (right, bottom) = np.min(corners, axis=0), np.max(corners, axis=0)
    return pygame.Rect(round(left), round(top), round(right - left), round(bottom - top))
