"""A player: every action is an event, as a window receives it."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import pygame

from sandbox.app.panels.level_list import LevelList
from sandbox.app.panels.side_panel import SidePanel
from sandbox.app.runs.session import Session
from sandbox.app.window import Window
from sandbox.model.shapes import XY

FRAME = 1 / 60  # s
PATIENCE = 240.0  # s

P = TypeVar("P")


class Person:
    """Drives a window by events."""

    def __init__(self, window: Window) -> None:
        self.window = window

    @property
    def session(self) -> Session:
        assert self.window.session is not None
        return self.window.session

    @property
    def side(self) -> SidePanel:
        assert self.window.panels.side is not None
        return self.window.panels.side

    @property
    def listed(self) -> LevelList:
        """The list of levels, which is shown."""
        assert self.window.panels.list is not None
        return self.window.panels.list

    def page(self, kind: type[P]) -> P:
        """Return the open page, which is of a given kind."""
        page = self.side.page
        assert isinstance(page, kind)
        return page

    def open(self, folder: Path, text: str) -> None:
        """Write a level to a file, and open it."""
        path = folder / "level.json"
        path.write_text(text, encoding="utf-8")
        self.window.open_level(str(path))
        self.wait()

    def wait(self, seconds: float = FRAME) -> None:
        """Watch for some time."""
        for _ in range(round(seconds / FRAME)):
            self.window.frame(FRAME)

    def resize(self, size: tuple[int, int]) -> None:
        """Make the window wider or narrower [px]."""
        self.window.surface = pygame.display.set_mode(size, pygame.RESIZABLE)
        pygame.event.post(pygame.Event(pygame.VIDEORESIZE, size=size, w=size[0], h=size[1]))
        self.wait()

    def press(self, key: int, text: str = "", mod: int = 0) -> None:
        """Press and release a key."""
        pygame.event.post(pygame.Event(pygame.KEYDOWN, key=key, unicode=text, mod=mod, scancode=0))
        if text.isprintable() and text:
            pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=text))
        pygame.event.post(pygame.Event(pygame.KEYUP, key=key, unicode=text, mod=mod, scancode=0))
        self.wait(2 * FRAME)  # what a widget makes of it is an event of the next frame

    def type(self, text: str) -> None:
        """Type a text, letter by letter."""
        for letter in text:
            self.press(pygame.key.key_code(letter), letter)

    def set_to(self, name: str, text: str) -> None:
        """Type the value of a parameter, and press Return."""
        field = self.side.parameters.row(name).field
        self.click(field.rect)
        field.set_text("")
        self.type(text)
        self.press(pygame.K_RETURN, "\r")
        self.wait(1.0)

    def move(self, pixel: XY) -> None:
        """Move the mouse."""
        before = pygame.mouse.get_pos()
        pygame.mouse.set_pos(pixel)
        pygame.event.get(pygame.MOUSEMOTION)
        by = int(pixel[0] - before[0]), int(pixel[1] - before[1])
        pygame.event.post(
            pygame.Event(pygame.MOUSEMOTION, pos=pixel, rel=by, buttons=(0, 0, 0), touch=False)
        )
        self.wait()

    def button(self, down: bool, pixel: XY, which: int = 1) -> None:
        """Press or release a button of the mouse."""
        kind = pygame.MOUSEBUTTONDOWN if down else pygame.MOUSEBUTTONUP
        pygame.event.post(pygame.Event(kind, pos=pixel, button=which, touch=False))
        self.wait()

    def click(self, place: XY | pygame.Rect) -> None:
        """Click on a place, or in the middle of a widget."""
        pixel = (
            (float(place.centerx), float(place.centery))
            if isinstance(place, pygame.Rect)
            else place
        )
        self.move(pixel)
        self.button(True, pixel)
        self.button(False, pixel)
        self.wait()  # what a widget makes of it is an event of the next frame

    def drag(self, start: XY, end: XY, which: int = 1, let_go: bool = True) -> None:
        """Drag from one place to another."""
        self.move(start)
        self.button(True, start, which)
        for i in range(1, 5):
            self.move(
                (start[0] + (end[0] - start[0]) * i / 4, start[1] + (end[1] - start[1]) * i / 4)
            )
        if let_go:
            self.button(False, end, which)

    def on_screen(self, point: XY) -> XY:
        """Return where a point of the plane [m] is in the window [px]."""
        x, y = self.window.stage.camera.to_screen(point)
        left, top = self.window.panels.layout.stage.topleft
        return x + left, y + top

    def color_at(self, pixel: XY) -> tuple[int, int, int]:
        """Return the colour of a pixel."""
        red, green, blue, _ = self.window.surface.get_at((round(pixel[0]), round(pixel[1])))
        return red, green, blue


def until(person: Person, true: Callable[[], bool]) -> None:
    """Watch, frame by frame, until a condition holds."""
    window, deadline = person.window, time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < deadline
        person.wait()
        if window.session is None or not window.session.playing:
            time.sleep(0.05)  # another process may need the time
