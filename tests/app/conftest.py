"""The app's tests run without a screen, driven by real events."""

import os

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"

from collections.abc import Iterator

import pygame
import pytest

from sandbox.app.text import Pen
from sandbox.app.window import Window
from tests.app.person import Person


@pytest.fixture
def pen() -> Pen:
    pygame.font.init()
    return Pen()


@pytest.fixture
def person() -> Iterator[Person]:
    """Somebody in front of a window in which nothing is open yet."""
    window = Window((1280, 800))
    pygame.event.clear()
    yield Person(window)
    pygame.display.quit()
