"""How long the window's frames take while a level plays with a graph and forces in sight."""

from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter, thread_time

import numpy as np
import pygame

from sandbox.app.runs.beginning import begin
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.session import Session
from sandbox.app.window import RATE, Window
from sandbox.model.errors import SandboxError

SHOWN = ("graph page", "forces")
"""What is opened beside the stage: a page whose graph grows, and the arrows of a free body."""

LOOKS = 5
"""How many pictures pygame_gui makes of a button, one a frame: as it is, under the mouse, ..."""


@dataclass(frozen=True, slots=True)
class Frames:
    """What the frames of a level took.

    Attributes
    ----------
    level
        Its name.
    opened
        From the command that opens it to its first picture [s].
    price
        What a second of it takes in the window beside the drawing, on the processor [s].
    median, late
        Of the frames' times on the processor: the middle, and what 99 of 100 stay below [s].
    speed
        How fast its time passed, 1 for real time.
    """

    level: str
    opened: float
    price: float
    median: float
    late: float
    speed: float

    @property
    def smooth(self) -> bool:
        """Whether 99 of 100 frames are in time."""
        return self.late <= 1 / RATE


def frames(name: str, size: tuple[int, int], seconds: float) -> Frames:
    """Play a level in a window that nobody sees, as long as it goes on, or begin it again.

    Raises
    ------
    SandboxError
        If there is no such level, or it does not run.
    """
    window = Window(size)
    try:
        begun = perf_counter()
        window.open_level(name)
        _show(window, 0.0)
        opened = perf_counter() - begun
        if window.session is None:
            raise SandboxError(f"{name} does not open: 'sandbox check {name}' says why")
        for command in SHOWN:
            window.do(command)
        for _ in range(LOOKS):  # what is opened is drawn once, and is no part of any later frame
            _show(window, 0.0)
        window.look_through()
        price = _price(window.session, seconds / 2)
        took, passed = _play(window, max(round(seconds * RATE), 1))
    finally:
        window.close()
    late = float(np.quantile(took, 0.99))
    speed = passed * RATE / len(took)
    return Frames(name, opened, price, float(np.median(took)), late, speed)


def _price(session: Session, most: float) -> float:
    """Return what a second of a level takes to be run and observed [s], in so much computing [s].

    It runs twice, and of each step the quicker counts: what disturbs one only adds to it.
    """
    first, second = (list(_steps(session, most / 2)) for _ in range(2))
    quicker = [min(pair) for pair in zip(first, second, strict=False)]
    return float(np.mean(quicker) / session.world.dt)


def _steps(session: Session, most: float) -> Iterator[float]:
    """Yield what each step of a run takes [s], for so much computing [s] or to its end."""
    begun = begin(session.begun_as, session.values, (), patient=False)
    run, first = LiveRun(session.original, begun), thread_time()
    before = first
    while run.failure is None and run.world.steps < run.end and before - first < most:
        run.advance()
        now = thread_time()
        yield now - before
        before = now


def _play(window: Window, count: int) -> tuple[list[float], float]:
    """Return what each of some frames took [s], and how much time of the level has passed [s]."""
    took, passed = [], 0.0
    for _ in range(count):
        assert window.session is not None
        if not window.session.playing:
            if window.session.world.steps:
                window.do("restart")
            window.do("play")
        before, begun = window.session.t, thread_time()
        _show(window, 1 / RATE)
        took.append(thread_time() - begun)
        passed += max(window.session.t - before, 0.0)
    return took, passed


def _show(window: Window, seconds: float) -> None:
    window.frame(seconds)
    pygame.display.flip()
