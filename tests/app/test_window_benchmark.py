"""A window is timed while it draws a playing level, and while it changes levels."""

import gc
from time import perf_counter
from unittest.mock import Mock

import pygame
import pytest
from pygame_gui.core import UIElement

from sandbox.app import main, window_benchmark
from sandbox.app.pages.forces.panel import ForcesPage
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.panels.verdicts_and_energies import VerdictsAndEnergies
from sandbox.app.widgets.widget_states_and_scrolling import Row
from sandbox.app.window import Window
from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from tests.app.person import FRAME, Person


def unfinished(window: Window) -> int:
    """Return how many visible widgets are not drawn in all their states: one is in each frame."""
    shapes = (
        element.drawable_shape
        for element in window.panels.manager.get_sprite_group().sprites()
        if isinstance(element, UIElement)
        and not (isinstance(element, Row) and not element.in_sight)
    )
    return sum(bool(shape.states_to_redraw_queue) for shape in shapes if shape)


@pytest.mark.sweep
def test_all_widgets_are_drawn_before_frames_are_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    left: list[int] = []
    play = window_benchmark._play

    def watched(window: Window, count: int) -> tuple[list[float], float]:
        left.append(unfinished(window))
        return play(window, count)

    monkeypatch.setattr(window_benchmark, "_play", watched)
    monkeypatch.setattr(window_benchmark, "first_picture", lambda _: 1.0)
    window_benchmark.time_window("newton/atwood", (900, 600), 0.1)

    assert left == [0]


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("asked", "before"),
    [("newton/incline", main.FIRST), (main.FIRST, "newton/atwood")],
)
def test_a_switch_is_from_another_level_to_the_one_that_is_asked_for(
    asked: str, before: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = Window((900, 600))
    opened: list[str] = []
    shown: list[str] = []
    open_level, flip = window.open_level, pygame.display.flip

    def watched(level: str) -> None:
        opened.append(level)
        open_level(level)

    def watched_flip() -> None:
        flip()
        shown.append(opened[-1])

    monkeypatch.setattr(window, "open_level", watched)
    monkeypatch.setattr(pygame.display, "flip", watched_flip)
    begun = perf_counter()
    took = window_benchmark._switch(window, asked)
    window.close()

    assert opened == [before, asked]
    assert shown == [before] * window_benchmark.LOOKS + [asked]
    assert 0 < took < perf_counter() - begun


@pytest.mark.sweep
def test_no_frame_draws_both_a_page_and_what_stands_below_it(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("newton/incline")
    person.press(pygame.K_d, "d")
    drawn: list[set[str]] = [set()]
    page, foot = GraphPage.update, VerdictsAndEnergies.update

    def draw_page(own: GraphPage) -> None:
        drawn[-1].add("page")
        page(own)

    def draw_foot(own: VerdictsAndEnergies) -> None:
        drawn[-1].add("foot")
        foot(own)

    monkeypatch.setattr(GraphPage, "update", draw_page)
    monkeypatch.setattr(VerdictsAndEnergies, "update", draw_foot)
    person.press(pygame.K_SPACE, " ")
    for _ in range(60):
        drawn.append(set())
        person.wait(FRAME)
    pages, feet = (sum(kind in frame for frame in drawn[1:]) for kind in ("page", "foot"))

    assert {"page", "foot"} not in drawn[1:]
    assert 8 <= pages <= 11
    assert abs(pages - feet) <= 1


def test_a_level_that_equals_the_one_before_is_compared_once(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Comparing levels of 500 bodies took 6 ms of each frame after an edit was undone."""
    person.window.open_level("newton/atwood")
    person.wait()
    session = person.session
    session.edit(load(find("newton/atwood")))
    person.wait(0.1)
    compared = Mock(return_value=True)
    monkeypatch.setattr(Level, "__eq__", compared)

    person.wait(0.1)

    assert not compared.called


def test_a_page_is_not_drawn_again_while_nothing_changes(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The editor's news were another tuple each time, so every page was drawn in each frame."""
    person.window.open_level("newton/incline")
    person.press(pygame.K_j, "j")
    person.wait(0.2)
    drawn = Mock()
    monkeypatch.setattr(ForcesPage, "update", drawn)

    person.wait(0.5)
    assert not drawn.called

    person.press(pygame.K_PERIOD, ".")
    person.wait(0.1)
    assert drawn.called


@pytest.mark.sweep
def test_a_window_is_gone_after_it_was_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    """All windows were kept until the end: 46 MB for each level."""
    monkeypatch.setattr(window_benchmark, "first_picture", lambda _: 1.0)

    window_benchmark.time_window("newton/atwood", (900, 600), 0.1)

    assert gc.get_freeze_count() == 0  # nothing is kept from Python's search for what is lost
