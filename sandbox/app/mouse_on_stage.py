"""The mouse on the stage, which drags bodies and forces, moves the view, zooms, and measures."""

from contextlib import suppress
from enum import Enum, auto

import pygame

from sandbox.app.measuring.protractor import Protractor
from sandbox.app.measuring.tape import Tape
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.widgets.round_slider_steps import rounded
from sandbox.model.errors import ValueRangeError
from sandbox.model.shapes import XY

ZOOM = 1.15  # per notch of the wheel
STILL = 3  # px, the least movement that makes a click a drag


class MouseAction(Enum):
    """The purpose of a button held down."""

    NOTHING = auto()
    PANNING = auto()
    PULLING = auto()
    FORCING = auto()
    MEASURING = auto()


class StageMouse:
    """The mouse over the stage."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._doing = MouseAction.NOTHING
        self._pressed: XY = (0.0, 0.0)
        self._moved = False
        self._components: dict[str, tuple[int, float]] = {}  # by parameter: axis, N at the start
        self.tape: Tape | Protractor | None = None
        """The last measurement, a distance or an angle; None after a click without Shift."""
        self._before: Tape | Protractor | None = None  # to which a protractor is attached

    @property
    def pulling(self) -> bool:
        """Whether it holds a body."""
        return self._doing is MouseAction.PULLING

    def process(self, event: pygame.event.Event, area: pygame.Rect, session: Session) -> None:
        """Handle a mouse event."""
        match event.type:
            case pygame.MOUSEBUTTONDOWN if area.collidepoint(event.pos):
                self._press(event, self._local(event.pos, area), session)
            case pygame.MOUSEMOTION:
                self._move(event.rel, self._local(event.pos, area), session)
            case pygame.MOUSEBUTTONUP if event.button in (1, 2, 3):
                session.release()
                self._doing = MouseAction.NOTHING

    def wheel(self, notches: float, pixel: XY, area: pygame.Rect) -> None:
        """Zoom around the mouse."""
        self._stage.camera.zoom(ZOOM**notches, self._local(pixel, area))

    @staticmethod
    def _local(pixel: XY, area: pygame.Rect) -> XY:
        return pixel[0] - area.x, pixel[1] - area.y

    def _press(self, event: pygame.event.Event, pixel: XY, session: Session) -> None:
        if event.button not in (1, 2, 3):
            return
        self._pressed, self._moved = pixel, False
        self._doing = MouseAction.PANNING
        if event.button != 1:
            return
        mods = pygame.key.get_mods()
        self._before = self.tape if mods & pygame.KMOD_CTRL else None
        self.tape = self._before
        point = self._stage.camera.to_world(pixel)
        if mods & pygame.KMOD_SHIFT:
            self._doing = MouseAction.MEASURING
        elif arrow := self._stage.tip_at(pixel):
            self._doing = MouseAction.FORCING
            handles = arrow.handles.items()
            self._components = {name: (axis, arrow.newtons[axis]) for axis, name in handles}
        elif body := self._stage.body_at(pixel):
            self._doing, session.looking.chosen = MouseAction.PULLING, body
            session.grab(body, point)

    def _move(self, by: tuple[int, int], pixel: XY, session: Session) -> None:
        x, y = self._pressed
        self._moved = self._moved or abs(pixel[0] - x) + abs(pixel[1] - y) >= STILL
        if not self._moved:
            return
        camera = self._stage.camera
        match self._doing:
            case MouseAction.PANNING:
                camera.pan(*by)
            case MouseAction.PULLING:
                session.drag(camera.to_world(pixel))
            case MouseAction.FORCING:
                self._force(pixel, session)
            case MouseAction.MEASURING:
                start, end = camera.to_world(self._pressed), camera.to_world(pixel)
                self.tape = Protractor.on(self._before, end) if self._before else Tape(start, end)
            case MouseAction.NOTHING:
                pass

    def _force(self, pixel: XY, session: Session) -> None:
        """Change a force by the movement of the mouse since it grabbed the tip."""
        x, y = self._pressed
        newton = self._stage.newton
        by = (pixel[0] - x) / newton, (y - pixel[1]) / newton
        parameters = session.level.parameters
        wanted = {
            name: rounded(parameters[name], first + by[axis])
            for name, (axis, first) in self._components.items()
            if name in parameters
        }
        if any(value != session.values[name] for name, value in wanted.items()):
            with suppress(ValueRangeError):  # values that the level does not allow are ignored
                session.restart(wanted)
