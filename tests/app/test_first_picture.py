"""What the first picture shows, and what is left to the moments after it."""

import subprocess
import sys

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.pages.register import PAGES, preload
from tests.app.person import Person

FIRST_PICTURE = """
import sys
from sandbox.app.main import first_picture
first_picture("newton/atwood")
print(*(name for name in sys.modules if name.startswith("sandbox.")))
"""

LATER = (
    "sandbox.app.building.editor",
    "sandbox.app.pages.accuracy.panel",
    "sandbox.app.pages.graph.panel",
    "sandbox.editing.suggested_checks",
    "sandbox.experiments.plan",
    "sandbox.physics.accuracy.error_causes_and_costs",
)
"""Modules that the first picture does not need."""


@pytest.mark.sweep
def test_the_first_picture_of_a_level_imports_no_page_that_it_does_not_show() -> None:
    command = [sys.executable, "-c", FIRST_PICTURE]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = done.stdout.split()

    assert not set(LATER) & set(found)
    assert len(found) < 460  # of 570 with all pages


def test_what_pages_consist_of_is_imported_after_the_first_picture() -> None:
    preload()

    assert set(LATER) <= set(sys.modules)
    for each in PAGES:
        contents = [part for part in (each.panel, each.card, each.worker) if part is not None]
        assert contents, each.name


def test_workers_are_made_once_time_passes(person: Person) -> None:
    window = person.window
    window.open_level("newton/atwood")
    window.frame(0.0)
    assert not window.workers._made

    window.frame(1 / 60)
    assert set(window.workers._made) == {each.command for each in PAGES if each.worker}


def test_while_the_first_level_is_built_the_window_shows_its_list_and_says_so(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was black, but for the sentence."""
    window, seen = person.window, list[pygame.Surface]()
    monkeypatch.setattr(pygame.display, "flip", lambda: seen.append(window.surface.copy()))
    window.open_level("hard/144-boxes")

    first, layout = seen[0], window.panels.layout
    rows = first.subsurface(layout.levels.move(0, 200).clip(first.get_rect()))
    assert len(np.unique(pygame.surfarray.array2d(rows))) > 20  # the titles of levels
    assert first.get_at(layout.stage.center)[:3] == theme.STAGE
    top = pygame.Rect(layout.stage.x, 0, layout.stage.width, 60)
    assert len(np.unique(pygame.surfarray.array2d(first.subsurface(top)))) > 20  # the sentence
