"""A probe for trails: time, position and speed of a body at the point under the mouse."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.observing.earlier_runs import have_same_bodies
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.runs.session import Session
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.words import formatting
from sandbox.model.shapes import XY

REACH = 8.0
"""The largest distance from the mouse to a trail [px]."""

DIGITS = 4
APART = "   "
"""The gap between the parts of the text."""
AWAY, PADDING = 16, 8  # px, from the instant to the text, and around the text
DISTANCES = range(AWAY, 160, 16)
"""The distances of the text from the instant that are tried, the nearest first [px]."""


class ProbedInstant(NamedTuple):
    """An instant of a run."""

    body: str
    """The body of the trail."""
    t: float
    """The time [s]."""
    place: XY
    """The position of the body for the observer [m]."""
    speed: float
    """The speed of the body for the observer [m/s]."""
    at: XY
    """Where this point of the trail is drawn now [m]."""
    distance: float
    """The distance to the mouse [px]."""
    scales: tuple[float, float]
    """The width of the view [m] and the highest speed [m/s], relative to which values are rounded.
    """

    @property
    def text(self) -> str:
        """The text that describes the instant."""
        wide, fastest = self.scales
        numbers = zip((*self.place, self.speed), (wide, wide, fastest), strict=True)
        x, y, speed = (
            formatting.number(formatting.without_rounding(value, scale), DIGITS)
            for value, scale in numbers
        )
        body = formatting.name_in_words(self.body)
        return APART.join((body, f"t = {self.t:.3f} s", f"({x}, {y}) m", f"{speed} m/s"))


def find(view: DrawingContext, session: Session, pixel: XY) -> ProbedInstant | None:
    """Return the instant of this run or an earlier one nearest to a pixel; None if none is near."""
    if not (view.few and view.shown["trail"] and have_same_bodies(session.world, view.world)):
        return None
    earlier = session.earlier if view.observer.place is None else ()
    histories = session.history, *(run.history for run in earlier)
    near = [found for history in histories for found in _near(view, history, pixel)]
    return min(near, key=lambda found: found.distance, default=None)


def _near(view: DrawingContext, history: ThinnedHistory, pixel: XY) -> Iterator[ProbedInstant]:
    """Yield the nearest instant of each moving body, if it is within `REACH`."""
    states, mouse, scale = history.snapshots, view.camera.to_world(pixel), view.camera.scale
    seen, velocity = (
        view.observer.relative(states.position),
        view.observer.relative(states.velocity),
    )
    paths = view.observer.path(states.position)
    for name, outline in view.outlines.items():
        if not outline.moves or outline.hidden:
            continue
        distance = np.hypot(*(paths[:, outline.row] - mouse).T) * scale
        i = int(distance.argmin())
        if distance[i] <= REACH:
            speed = float(np.hypot(*velocity[i, outline.row]))
            place, at = (tuple(found[i, outline.row].tolist()) for found in (seen, paths))
            scales = view.width, view.fastest
            yield ProbedInstant(
                name, float(states.t[i]), place, speed, at, float(distance[i]), scales
            )


def draw(surface: pygame.Surface, view: DrawingContext, session: Session, pixel: XY) -> None:
    """Mark and describe the point of a trail under the mouse."""
    over = surface.get_rect().collidepoint(pixel)
    found = find(view, session, pixel) if over else None
    if found is None:
        return
    at = view.camera.to_screen(found.at)
    pygame.draw.aacircle(surface, theme.NOTICE, at, 5, 2)
    text = _written(view.pen, found.text, surface.width - 2 * PADDING)
    plate = _place(surface.get_rect(), view, at, (text.width + 2 * PADDING, text.height + PADDING))
    pygame.draw.rect(surface, theme.RAISED, plate, border_radius=4)
    pygame.draw.rect(surface, theme.EDGE, plate, 1, border_radius=4)
    surface.blit(text, text.get_rect(center=plate.center))


def _place(bounds: pygame.Rect, view: DrawingContext, at: XY, size: tuple[int, int]) -> pygame.Rect:
    """Return the place of the text of some size near an instant, off bodies and other labels.

    If there is none, it is below the instant, or above it at the lower edge.
    """
    plate, x, y = pygame.Rect((0, 0), size), round(at[0]), round(at[1])
    around = [
        place.clamp(view.labels.bounds)
        for away in DISTANCES
        for place in (
            plate.move_to(midtop=(x, y + away)),
            plate.move_to(midbottom=(x, y - away)),
            plate.move_to(midleft=(x + away, y)),
            plate.move_to(midright=(x - away, y)),
        )
    ]
    free = view.labels.place_for(around, view.boxes, name="probe", strict=True)
    below = plate.move_to(midtop=(x, y + AWAY))
    if below.bottom > bounds.bottom:
        below.bottom = y - AWAY
    return free or below.clamp(bounds)


def _written(pen: Pen, text: str, room: int) -> pygame.Surface:
    """Return a text as a picture; if it is wider than the room [px], with a line for each part."""
    lines = [pen.write(text, 13)]
    if lines[0].width > room:
        lines = [pen.write(part, 13) for part in text.split(APART)]
    size = max(line.width for line in lines), sum(line.height for line in lines)
    picture, y = pygame.Surface(size, pygame.SRCALPHA), 0
    for line in lines:
        picture.blit(line, (0, y))
        y += line.height
    return picture
