"""What the mouse does on the stage: drag bodies, move the view, zoom, measure."""

from enum import Enum, auto

import pygame

from sandbox.app.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.tape import Tape
from sandbox.model.shapes import XY

ZOOM = 1.15  # a notch of the wheel
STILL = 3  # px; a click that moves less does not touch the scene


class Doing(Enum):
    """What a button held down is for."""

    NOTHING = auto()
    PANNING = auto()
    PULLING = auto()
    MEASURING = auto()


class Hand:
    """The mouse over the stage.

    Attributes
    ----------
    tape
        What was measured last; None after a click elsewhere.
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._doing = Doing.NOTHING
        self._pressed: XY = (0.0, 0.0)
        self._moved = False
        self.tape: Tape | None = None

    def process(self, event: pygame.event.Event, area: pygame.Rect, session: Session) -> None:
        """Do what a mouse event over the window asks for."""
        match event.type:
            case pygame.MOUSEBUTTONDOWN if area.collidepoint(event.pos):
                self._press(event, self._local(event.pos, area), session)
            case pygame.MOUSEMOTION:
                self._move(event.rel, self._local(event.pos, area), session)
            case pygame.MOUSEBUTTONUP if event.button in (1, 2, 3):
                session.release()
                self._doing = Doing.NOTHING

    def wheel(self, notches: float, pixel: XY, area: pygame.Rect) -> None:
        """Zoom about the mouse."""
        self._stage.camera.zoom(ZOOM**notches, self._local(pixel, area))

    @staticmethod
    def _local(pixel: XY, area: pygame.Rect) -> XY:
        return pixel[0] - area.x, pixel[1] - area.y

    def _press(self, event: pygame.event.Event, pixel: XY, session: Session) -> None:
        if event.button not in (1, 2, 3):
            return
        self._pressed, self._moved = pixel, False
        self._doing = Doing.PANNING
        if event.button != 1:
            return
        self.tape = None
        point = self._stage.camera.to_world(pixel)
        if pygame.key.get_mods() & pygame.KMOD_SHIFT:
            self._doing = Doing.MEASURING
        elif body := self._stage.body_at(pixel):
            self._doing = Doing.PULLING
            session.grab(body, point)

    def _move(self, by: tuple[int, int], pixel: XY, session: Session) -> None:
        x, y = self._pressed
        self._moved = self._moved or abs(pixel[0] - x) + abs(pixel[1] - y) >= STILL
        if not self._moved:
            return
        camera = self._stage.camera
        match self._doing:
            case Doing.PANNING:
                camera.pan(*by)
            case Doing.PULLING:
                session.drag(camera.to_world(pixel))
            case Doing.MEASURING:
                self.tape = Tape(camera.to_world(self._pressed), camera.to_world(pixel))
            case Doing.NOTHING:
                pass
