"""The app's tests run without a screen, driven by real events."""

import os

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"
os.environ["LANGUAGE"] = "en"  # whoever runs them, wherever

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files import challenge_stars, preferences, recent_files
from sandbox.app.files.level_list_entries import Entry
from sandbox.app.home import picture_cache
from sandbox.app.panels import level_list
from sandbox.app.runs import crash_recovery
from sandbox.app.window import Window
from sandbox.app.words import language
from sandbox.editing import draft_recovery
from tests.app.person import Person

EVERY = 12
"""Of so many tests of a module that open a window, the quick tests take the first."""

_WINDOWS = pytest.StashKey[int]()


def pytest_itemcollected(item: pytest.Item) -> None:
    """Leave most tests that open a window to `make sweep`.

    Opening a window takes longer than testing it. Each module keeps some quick tests of them.
    """
    module = item.getparent(pytest.Module)
    if module is None or "person" not in getattr(item, "fixturenames", ()):
        return
    count = module.stash.get(_WINDOWS, 0)
    module.stash[_WINDOWS] = count + 1
    if count % EVERY:
        item.add_marker(pytest.mark.sweep)


@pytest.fixture
def pen() -> Pen:
    pygame.font.init()
    return Pen()


@pytest.fixture(autouse=True)
def _nothing_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Read and write no stars, drafts and runs but those of the test itself."""
    monkeypatch.setattr(challenge_stars, "file", lambda: tmp_path / "stars" / "stars.json")
    monkeypatch.setattr(draft_recovery, "folder", lambda: tmp_path / "drafts")
    monkeypatch.setattr(crash_recovery, "folder", lambda: tmp_path / "runs")


@pytest.fixture(autouse=True)
def _nothing_remembered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Read and write no recent files and pictures but those of the test itself."""
    monkeypatch.setattr(recent_files, "file", lambda: tmp_path / "recent" / "recent.json")
    monkeypatch.setattr(preferences, "file", lambda: tmp_path / "settings" / "settings.json")
    monkeypatch.setattr(picture_cache, "folder", lambda: tmp_path / "pictures")


@pytest.fixture
def few() -> int:
    """List only a few levels: making a button for each takes longer than most tests."""
    return 4


@cache
def _first(count: int) -> tuple[Entry, ...]:
    return tuple(level_list.entries()[:count])


@pytest.fixture
def person(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, few: int
) -> Iterator[Person]:
    """A person in front of a window in which nothing is open yet."""
    if not request.node.get_closest_marker("all_levels"):
        listed = _first(few)
        monkeypatch.setattr(level_list, "entries", lambda: list(listed))
    window = Window((1280, 800))
    pygame.event.get()  # `clear` would never let go of the widgets that events are about
    yield Person(window)
    window.close()
    pygame.event.get()
    theme.use(theme.DARK)
    language.use(language.ENGLISH)
    pygame.display.quit()
