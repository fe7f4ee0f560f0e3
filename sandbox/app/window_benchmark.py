"""Measures the times to the first picture, from the start on, to another level, and for a frame."""

import gc
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter, thread_time

import numpy as np
import pygame

from sandbox.app.main import FIRST
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.run_start import begin
from sandbox.app.runs.session import Session
from sandbox.app.window import RATE, Window
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import without_links
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message

STARTS = 2
"""The number of starts. The fastest one counts, since disturbances only add."""

LIMIT = 120.0
"""The longest time of a start [s]."""


BEFORE = (FIRST, "newton/atwood")
"""The levels from which the change to another level is timed."""

SHOWN = ("graph page", "forces")
"""The commands before the timing: a page with a growing graph, and the arrows of a free body."""

LOOKS = 5
"""The number of pictures that pygame_gui makes of a button, one per frame: normal, hovered, ..."""

BOUNDS = {"first_picture": 1.5, "switch": 0.3, "frame_p99": 1 / RATE}
"""The largest allowed values of the attributes of a timing [s]."""


@dataclass(frozen=True, slots=True)
class Timing:
    """The times of a level in the window."""

    level: str
    """The name of the level."""
    first_picture: float
    """The time from the start of the program to the first picture of the level [s]."""
    switch: float
    """The time from opening the level, while another one is open, to its first picture [s]."""
    cost: float
    """The processor time for a second of the level in the window, without drawing [s]."""
    frame_p50: float
    """The median of the processor times of frames [s]."""
    frame_p99: float
    """The 99th percentile of the processor times of frames [s]."""
    speed: float
    """The simulated time over real time."""

    @property
    def beyond(self) -> tuple[str, ...]:
        """The attributes that exceed their bounds."""
        return tuple(name for name, bound in BOUNDS.items() if getattr(self, name) > bound)

    @property
    def smooth(self) -> bool:
        """Whether 99 of 100 frames are within their bound."""
        return "frame_p99" not in self.beyond


def time_window(name: str, size: tuple[int, int], seconds: float) -> Timing:
    """Start the program on a level, then play it for some seconds in a hidden window of a size.

    A run that ends is restarted. The program's window has its default size. Raises `SandboxError`
    if the level does not exist, or does not run.
    """
    window = Window(size)
    try:
        switch = _switch(window, name)
        if window.session is None:
            raise SandboxError("{name} does not open: 'sandbox check {name}' says why", name=name)
        for command in SHOWN:
            window.do(command)
        _settle(window)
        cost = _cost(window.session, seconds / 2)
        took, passed = _play(window, max(round(seconds * RATE), 1))
    finally:
        window.close()
        gc.unfreeze()  # or every window would be kept to the end
    middle, late = (float(np.quantile(took, share)) for share in (0.5, 0.99))
    return Timing(
        level=name, first_picture=first_picture(name), switch=switch, cost=cost,
        frame_p50=middle, frame_p99=late, speed=passed * RATE / len(took),
    )  # fmt: skip


def _switch(window: Window, name: str) -> float:
    """Open another level, then this one, and return the time until this one is shown [s]."""
    path = without_links(level_catalog.find(name))
    window.open_level(next(one for one in BEFORE if without_links(level_catalog.find(one)) != path))
    _settle(window)
    begun = perf_counter()
    window.open_level(name)
    _show(window, 0.0)
    return perf_counter() - begun


def _settle(window: Window) -> None:
    """Draw all pictures of widgets, which are drawn only once, so that later frames lack them."""
    for _ in range(LOOKS):
        _show(window, 0.0)
    window.preload()


def _cost(session: Session, most: float) -> float:
    """Return the time to run and observe a second of a level [s], within a time limit [s].

    The level runs twice, and the shorter time of each step counts: disturbances only add.
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
    """Return the processor time of each frame [s], and the simulated time [s]."""
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


def first_picture(level: str) -> float:
    """Return the time from the start of a program that plays a level to its first picture [s].

    Raises `SandboxError` if a program ends without a picture, or shows none within `LIMIT`.
    """
    return min(_start(level) for _ in range(STARTS))


def _start(level: str) -> float:
    """Return the time of one start [s]; `perf_counter` is the same clock in both processes."""
    command = [sys.executable, "-m", "sandbox", "play", "--first-picture", "--", level]
    begun = perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired as error:
        raise SandboxError(
            "{level}: a window that was started on it showed no picture in {limit:g} s",
            level=level,
            limit=LIMIT,
        ) from error
    if done.returncode != 0:
        reason = done.stderr.strip().rpartition("\n")[2] or Message(
            "exit status {status}", status=done.returncode
        )
        raise SandboxError(
            "{level}: a window that was started on it showed no picture: {reason}",
            level=level,
            reason=reason,
        )
    return float(done.stdout) - begun
