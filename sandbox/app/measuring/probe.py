"""A probe for trails: time, position and speed of a body at the point under the mouse."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.drawing import theme
from sandbox.app.observing.earlier_runs import alike
from sandbox.app.observing.state_history import History
from sandbox.app.runs.session import Session
from sandbox.app.stage.view import View
from sandbox.app.words import formatting
from sandbox.model.shapes import XY

REACH = 8.0
"""The largest distance from the mouse to a trail [px]."""

DIGITS = 4
AWAY, PADDING = 16, 8  # px, from the instant to the text, and around the text


class Found(NamedTuple):
    """An instant of a run."""

    body: str
    """The body of the trail."""
    t: float
    place: XY
    speed: float
    """The time, position and speed of the body [s, m, m/s]."""
    distance: float
    """The distance to the mouse [px]."""
    scales: tuple[float, float]
    """The width of the view [m] and the highest speed [m/s], relative to which values are rounded.
    """

    @property
    def text(self) -> str:
        """The text that describes the instant."""
        wide, fastest = self.scales
        told = zip((*self.place, self.speed), (wide, wide, fastest), strict=True)
        x, y, speed = (
            formatting.number(formatting.without_rounding(value, scale), DIGITS)
            for value, scale in told
        )
        return f"{self.body}   t = {self.t:.3f} s   ({x}, {y}) m   {speed} m/s"


def find(view: View, session: Session, pixel: XY) -> Found | None:
    """Return the instant of this run or an earlier one nearest to a pixel; None if none is near."""
    if not (view.few and view.shown["trail"] and alike(session.world, view.world)):
        return None
    histories = session.history, *(run.history for run in session.earlier)
    near = [found for history in histories for found in _near(view, history, pixel)]
    return min(near, key=lambda found: found.distance, default=None)


def _near(view: View, history: History, pixel: XY) -> Iterator[Found]:
    """Yield the nearest instant of each moving body, if it is within `REACH`."""
    states, mouse, scale = history.snapshots, view.camera.to_world(pixel), view.camera.scale
    for name, outline in view.outlines.items():
        if not outline.moves or outline.hidden:
            continue
        places = states.position[:, outline.row]
        distance = np.hypot(*(places - mouse).T) * scale
        i = int(distance.argmin())
        if distance[i] <= REACH:
            speed = float(np.hypot(*states.velocity[i, outline.row]))
            x, y = places[i].tolist()
            scales = view.width, view.fastest
            yield Found(name, float(states.t[i]), (x, y), speed, float(distance[i]), scales)


def draw(surface: pygame.Surface, view: View, session: Session, pixel: XY) -> None:
    """Mark and describe the point of a trail under the mouse."""
    over = surface.get_rect().collidepoint(pixel)
    found = find(view, session, pixel) if over else None
    if found is None:
        return
    at = view.camera.to_screen(found.place)
    pygame.draw.aacircle(surface, theme.NOTICE, at, 5, 2)
    text = view.pen.write(found.text, 13)
    plate = text.get_rect(midtop=(at[0], at[1] + AWAY)).inflate(2 * PADDING, PADDING)
    if plate.bottom > surface.get_height():
        plate.bottom = round(at[1] - AWAY)
    plate.clamp_ip(surface.get_rect())
    pygame.draw.rect(surface, theme.RAISED, plate, border_radius=4)
    pygame.draw.rect(surface, theme.EDGE, plate, 1, border_radius=4)
    surface.blit(text, text.get_rect(center=plate.center))
