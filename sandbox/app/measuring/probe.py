"""A probe on the trails: when the body under the mouse was there, and how fast."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.drawing import theme
from sandbox.app.observing.history import History
from sandbox.app.runs.session import Session
from sandbox.app.stage.view import View
from sandbox.app.words import formatting
from sandbox.model.shapes import XY

REACH = 8.0
"""How near to a trail the mouse has to be [px]."""

DIGITS = 4


class Found(NamedTuple):
    """An instant of a run.

    Attributes
    ----------
    body
        Whose trail it is.
    t, place, speed
        When, where, and how fast it was there [s, m, m/s].
    distance
        From there to the mouse [px].
    """

    body: str
    t: float
    place: XY
    speed: float
    distance: float

    @property
    def text(self) -> str:
        """The text that describes it."""
        x, y, speed = (formatting.number(value, DIGITS) for value in (*self.place, self.speed))
        return f"{self.body}   t = {self.t:.3f} s   ({x}, {y}) m   {speed} m/s"


def find(view: View, session: Session, pixel: XY) -> Found | None:
    """Return the nearest instant that is kept of the run, or of one before; None if none is near.

    Parameters
    ----------
    view
        What is looked at, from where.
    session
        Whose runs.
    pixel
        The mouse, from the stage's corner [px].
    """
    if not (view.few and view.shown["trail"]):
        return None
    histories = session.history, *(run.history for run in session.earlier)
    near = [found for history in histories for found in _near(view, history, pixel)]
    return min(near, key=lambda found: found.distance, default=None)


def _near(view: View, history: History, pixel: XY) -> Iterator[Found]:
    """Yield the nearest instant of each moving body, if that is near enough."""
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
            yield Found(name, float(states.t[i]), (x, y), speed, float(distance[i]))


def draw(surface: pygame.Surface, view: View, session: Session, pixel: XY) -> None:
    """Mark what the mouse points at on a trail, and tell it."""
    over = surface.get_rect().collidepoint(pixel)
    found = find(view, session, pixel) if over else None
    if found is None:
        return
    at = view.camera.to_screen(found.place)
    pygame.draw.aacircle(surface, theme.NOTICE, at, 5, 2)
    text = view.pen.outlined(found.text, 14)
    place = text.get_rect(midtop=(at[0], at[1] + 12))
    surface.blit(text, place.clamp(surface.get_rect()))
