"""Starts the app."""

import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter

import pygame

from sandbox.app.home.unfinished_work_strip import notice, unsaved
from sandbox.app.malloc_tuning import give_back_large_blocks
from sandbox.app.window import Window

FIRST = "kinematics/projectile"
"""The level that is opened behind the home page at the start."""

_HEADLESS = {"dummy", "offscreen"}


def has_display() -> bool:
    """Whether a window can be opened on this machine; if so, the display stays open.

    Closing it could make an X server without other clients reset, and refuse connections meanwhile.
    """
    somewhere = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    chosen = os.environ.get("SDL_VIDEODRIVER", "")
    if chosen in _HEADLESS or (sys.platform == "linux" and not somewhere and not chosen):
        return False  # asking SDL would print why
    try:
        pygame.display.init()
        found = pygame.display.get_driver() not in _HEADLESS
    except pygame.error:
        return False
    if not found:
        pygame.display.quit()
    return found


def run(
    level: str | None = None,
    settings: Mapping[str, float] | None = None,
    accuracy: float | None = None,
    *,
    racing: bool = False,
) -> None:
    """Open the window, and return when it is closed.

    Without a level (a name or a path), it shows the home page. An accuracy replaces the level's
    stepping; `racing` starts the race of schemes.
    """
    with _opened(level, settings, accuracy, racing) as window:
        window.run()


def first_picture(
    level: str,
    settings: Mapping[str, float] | None = None,
    accuracy: float | None = None,
    *,
    racing: bool = False,
) -> float:
    """Open the window as `run` does, and return the time of its first picture [s].

    The clock is `perf_counter`, which all processes share.
    """
    with _opened(level, settings, accuracy, racing) as window:
        next(window.pictures())
        return perf_counter()


@contextmanager
def _opened(
    level: str | None, settings: Mapping[str, float] | None, accuracy: float | None, racing: bool
) -> Iterator[Window]:
    """Open the window in its initial state, and close it at the end of the context."""
    # a tooltip that does not fit is cut off, which needs no warning
    warnings.filterwarnings("ignore", "Unable to fit tool tip", UserWarning)
    give_back_large_blocks()
    window = Window()
    with window.hold_up.watched():
        window.open_level(level or FIRST, settings, accuracy)
    if level is None:
        window.do("home")
    elif left := unsaved():
        window.banner.write(notice(left[0]), lasting=True)
    if racing:
        window.do("race")
    try:
        yield window
    finally:
        window.close()
        pygame.quit()
