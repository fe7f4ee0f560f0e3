"""Somebody without any plan sits in front of the window: `python -m tests.endurance.window`.

Events at random, several to a frame: every key, letters and characters that no font has, clicks,
drags and wheels anywhere, windows of any size, files that are dropped on it, good and bad. Whatever
leaves `Window.frame` is a defect. Memory is read again and again, each time with the same levels
open in a window that looks as it did at first; the first readings come after all levels and all
pages have been shown. What is kept, such as settings, goes to a home of its own.
"""

import os

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"

import tempfile
from collections import deque
from pathlib import Path
from random import Random
from statistics import median
from time import monotonic
from typing import Any

import pygame
import typer

from sandbox.app.files.preferences import Preferences
from sandbox.app.keymap import BINDINGS
from sandbox.app.malloc_tuning import give_back_large_blocks
from sandbox.app.pages.register import PAGES
from sandbox.app.window import Window
from sandbox.model import level_catalog
from tests.elsewhere import move_home
from tests.endurance.memory import held
from validation.fuzz.command import made
from validation.fuzz.mutated_levels import mutated

FRAME = 1 / 60  # s
PARTS, LAST = 20, 5
"""How often memory is read, and of how many of the readings the first and the last medians are."""

LEAK = 20.0
"""MB, by which what is held may grow from the first readings to the last."""

SAME = ("newton/atwood", "momentum/cradle", "lagrange/double-pendulum")
"""The levels that are open, one after the other, where memory is read."""

LOOKS = 5
"""Frames that each of them is shown before."""

TEXT = "abcxyz0123456789.-+eE /\u200b\u202e\u0301é∞𝄞\t\n\x00"
"""What may be typed: with characters that have no width, no glyph, or no meaning."""

SIZES = ((1280, 800), (640, 480), (320, 200), (1920, 1080), (200, 900), (1600, 300))
KEYS = tuple((key, "") for b in BINDINGS for key in b.keys) + tuple(
    (0, letter) for b in BINDINGS for letter in b.characters
)
LEAVE = pygame.K_ESCAPE


class Monkey:
    """Posts events at random; `last` are the latest of them."""

    def __init__(self, window: Window, seed: int, folder: Path) -> None:
        self.window, self.last = window, deque[str](maxlen=40)
        self._random, self._folder = Random(seed), folder
        self._down = 0  # the button that is held

    def act(self) -> None:
        """Post one event."""
        kind = self._random.choices(
            (
                self._key,
                self._letter,
                self._move,
                self._button,
                self._wheel,
                self._file,
                self._size,
            ),
            (30, 12, 24, 28, 4, 1.5, 0.15),
        )[0]
        kind()

    def _post(self, kind: int, **said: Any) -> None:  # noqa: ANN401 (whatever an event holds)
        self.last.append(f"{pygame.event.event_name(kind)} {said}")
        pygame.event.post(pygame.Event(kind, **said))

    def _key(self) -> None:
        key, letter = self._random.choice(KEYS)
        if key == LEAVE and self._random.random() < 0.5:
            key = pygame.K_BACKSPACE
        self._press(key or ord(letter.lower()), letter)

    def _letter(self) -> None:
        letter = self._random.choice(TEXT)
        self._press(ord(letter), letter)

    def _press(self, key: int, letter: str) -> None:
        mod = self._random.choice((0, 0, 0, pygame.KMOD_SHIFT, pygame.KMOD_CTRL))
        said = {"key": key, "unicode": letter, "mod": mod, "scancode": 0}
        self._post(pygame.KEYDOWN, **said)
        if letter:
            self._post(pygame.TEXTINPUT, text=letter)
        self._post(pygame.KEYUP, **said)

    def _place(self) -> tuple[int, int]:
        width, height = self.window.surface.size
        return self._random.randrange(-5, width + 5), self._random.randrange(-5, height + 5)

    def _move(self) -> None:
        place, before = self._place(), pygame.mouse.get_pos()
        pygame.mouse.set_pos(place)
        by = place[0] - before[0], place[1] - before[1]
        held_down = tuple(int(i + 1 == self._down) for i in range(3))
        self._post(pygame.MOUSEMOTION, pos=place, rel=by, buttons=held_down, touch=False)

    def _button(self) -> None:
        kind = pygame.MOUSEBUTTONUP if self._down else pygame.MOUSEBUTTONDOWN
        button = self._down or self._random.choice((1, 1, 1, 1, 2, 3))
        self._down = 0 if self._down else button
        self._post(kind, pos=pygame.mouse.get_pos(), button=button, touch=False)

    def _wheel(self) -> None:
        by = self._random.choice((-3, -1, -0.2, 0.2, 1, 3))
        said = {"x": 0, "y": round(by), "precise_x": 0.0, "precise_y": by, "flipped": False}
        self._post(pygame.MOUSEWHEEL, **said, touch=False)

    def _size(self) -> None:
        size = self._random.choice(SIZES)
        pygame.display.set_mode(size, pygame.RESIZABLE)
        self._post(pygame.VIDEORESIZE, size=size, w=size[0], h=size[1])

    def _file(self) -> None:
        if self._random.random() < 0.5:
            name = str(level_catalog.find(self._random.choice(level_catalog.names())))
        else:
            name = str(self._folder / "dropped.json")
            Path(name).write_text(self._content(), encoding="utf-8")
        self._post(pygame.DROPFILE, file=name)

    def _content(self) -> str:
        import json

        kind = self._random.randrange(3)
        if kind == 0:
            return json.dumps(made(self._random.randrange(10**6), 0))
        text = json.dumps(mutated(self._random))
        return text if kind == 1 else text[: self._random.randrange(len(text))]


def _reading(window: Window) -> float:
    """Return the memory in a state that is always the same [MB]: the median of some readings."""
    pygame.display.set_mode(SIZES[0], pygame.RESIZABLE)
    pygame.event.post(pygame.Event(pygame.VIDEORESIZE, size=SIZES[0], w=SIZES[0][0], h=SIZES[0][1]))
    window.comfort.choose(**Preferences().model_dump())
    window.panels.show(PAGES[0].command)
    window.panels.list_all()
    window.panels._hidden.clear()
    if window.panels.home.open:
        window.go_home()
    looks = []
    for name in SAME:
        window.open_level(name)
        for _ in range(LOOKS):
            window.frame(FRAME)
        looks.append(held())
    return median(looks)


def main(events: int = 100_000, seed: int = 0) -> None:
    """Post a number of events, and report the trend of memory."""
    with tempfile.TemporaryDirectory() as folder:
        move_home(folder)
        give_back_large_blocks()  # as the app does
        readings = _readings(events, seed, Path(folder))
    grown = median(readings[-LAST:]) - median(readings[1 : 1 + LAST])
    typer.echo(f"grown by {grown:.1f} MB from the first readings to the last; {LEAK:g} may be")
    raise typer.Exit(grown > LEAK)


def _readings(events: int, seed: int, folder: Path) -> list[float]:
    """Post a number of events; return the memory before the first and after each part [MB]."""
    window, begun = Window(), monotonic()
    for name in level_catalog.names():  # what is made but once is there then
        window.open_level(name)
        for page in PAGES:
            window.do(page.command)
            window.frame(FRAME)
    readings = [_reading(window)]
    typer.echo(f"all levels and pages were open: {readings[0]:.1f} MB")
    monkey = Monkey(window, seed, folder)
    for number in range(events):
        monkey.act()
        if number % 3 == 0:
            _frame(window, monkey, number)
        if number % (events // PARTS) == events // PARTS - 1:
            readings.append(_reading(window))
            told = f"{number + 1:,} events, {monotonic() - begun:.0f} s"
            typer.echo(f"{told}: {readings[-1]:.1f} MB")
    window.close()
    return readings


def _frame(window: Window, monkey: Monkey, number: int) -> None:
    try:
        window.frame(FRAME)
    except Exception:
        typer.echo(f"event {number:,}, after:\n" + "\n".join(monkey.last), err=True)
        raise
    window.open = True  # whoever has left comes back


if __name__ == "__main__":
    typer.run(main)
