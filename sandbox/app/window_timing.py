"""How long the window takes: to its first picture, to another level, and for each of its frames."""

from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter, thread_time

import numpy as np
import pygame

from sandbox.app.main import FIRST
from sandbox.app.runs.beginning import begin
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.session import Session
from sandbox.app.startup_timing import first_picture
from sandbox.app.window import RATE, Window
from sandbox.model import catalog
from sandbox.model.errors import SandboxError
from sandbox.model.message import Message

BEFORE = (FIRST, "newton/atwood")
"""The levels from which the change to another level is timed."""

SHOWN = ("graph page", "forces")
"""What is open beside the stage: a page with a growing graph, and the arrows of a free body."""

LOOKS = 5
"""How many pictures pygame_gui makes of a button, one per frame: normal, hovered, ..."""

BOUNDS = {"first_picture": 1.5, "switch": 0.3, "frame_p99": 1 / RATE}
"""The largest allowed values of the attributes of a timing [s]."""


@dataclass(frozen=True, slots=True)
class Timing:
    """What a level took in the window.

    Attributes
    ----------
    level
        The name of the level.
    first_picture
        From the start of a program that plays it to its first picture [s].
    switch
        From the command that opens it, while another level is open, to its first picture [s].
    cost
        What a second of it takes in the window beside the drawing, on the processor [s].
    frame_p50, frame_p99
        Of the frames' times on the processor: the middle, and what 99 of 100 stay below [s].
    speed
        How fast its time passed, 1 for real time.
    """

    level: str
    first_picture: float
    switch: float
    cost: float
    frame_p50: float
    frame_p99: float
    speed: float

    @property
    def beyond(self) -> tuple[str, ...]:
        """The attributes that exceed their bounds."""
        return tuple(name for name, bound in BOUNDS.items() if getattr(self, name) > bound)

    @property
    def smooth(self) -> bool:
        """Whether 99 of 100 frames are in time."""
        return "frame_p99" not in self.beyond


def time_window(name: str, size: tuple[int, int], seconds: float) -> Timing:
    """Start the program on a level, open the level in a hidden window, and play it there.

    It plays as long as it goes on, or begins again. The program has a window of its usual size.

    Parameters
    ----------
    name
        The level.
    size
        Of the window in which it plays [px].
    seconds
        How long it plays.

    Raises
    ------
    SandboxError
        If there is no such level, or it does not run.
    """
    window = Window(size)
    try:
        switch = _switch(window, name)
        if window.session is None:
            raise SandboxError(
                Message("{name} does not open: 'sandbox check {name}' says why", name=name)
            )
        for command in SHOWN:
            window.do(command)
        _settle(window)
        cost = _cost(window.session, seconds / 2)
        took, passed = _play(window, max(round(seconds * RATE), 1))
    finally:
        window.close()
    middle, late = (float(np.quantile(took, share)) for share in (0.5, 0.99))
    return Timing(
        level=name, first_picture=first_picture(name), switch=switch, cost=cost,
        frame_p50=middle, frame_p99=late, speed=passed * RATE / len(took),
    )  # fmt: skip


def _switch(window: Window, name: str) -> float:
    """Open another level, then this one, and return what that takes until it is shown [s]."""
    path = catalog.find(name).resolve()
    window.open_level(next(one for one in BEFORE if catalog.find(one).resolve() != path))
    _settle(window)
    begun = perf_counter()
    window.open_level(name)
    _show(window, 0.0)
    return perf_counter() - begun


def _settle(window: Window) -> None:
    """Draw all widgets as `LOOKS` says: what is drawn once is no part of any later frame."""
    for _ in range(LOOKS):
        _show(window, 0.0)
    window.look_through()


def _cost(session: Session, most: float) -> float:
    """Return the time to run and observe a second of a level [s], within a time limit [s].

    It runs twice, and of each step the quicker counts: what disturbs one only adds to it.
    """
    first, second = (list(_steps(session, most / 2)) for _ in range(2))
    quicker = [min(pair) for pair in zip(first, second, strict=False)]
    return float(np.mean(quicker) / session.world.dt)


def _steps(session: Session, most: float) -> Iterator[float]:
    """Yield the time of each step of a run [s], within a time limit [s] or to the end."""
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
