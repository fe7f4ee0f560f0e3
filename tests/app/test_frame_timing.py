"""What is timed of a window is what it draws while a level plays, and not how it is laid out."""

import pygame
import pytest
from pygame_gui.core import UIElement

from sandbox.app import frame_timing
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.panels.footer import Foot
from sandbox.app.widgets.row import Row
from sandbox.app.window import Window
from tests.app.person import FRAME, Person


def unfinished(window: Window) -> int:
    """Return how many widgets in sight are not drawn in all their states: one is in each frame."""
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
    play = frame_timing._play

    def watched(window: Window, count: int) -> tuple[list[float], float]:
        left.append(unfinished(window))
        return play(window, count)

    monkeypatch.setattr(frame_timing, "_play", watched)
    frame_timing.frames("newton/atwood", (900, 600), 0.1)

    assert left == [0]


def test_no_frame_draws_both_a_page_and_what_stands_below_it(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("newton/incline")
    person.press(pygame.K_d, "d")
    drawn: list[set[str]] = [set()]
    page, foot = GraphPage.update, Foot.update

    def draw_page(own: GraphPage) -> None:
        drawn[-1].add("page")
        page(own)

    def draw_foot(own: Foot) -> None:
        drawn[-1].add("foot")
        foot(own)

    monkeypatch.setattr(GraphPage, "update", draw_page)
    monkeypatch.setattr(Foot, "update", draw_foot)
    person.press(pygame.K_SPACE, " ")
    for _ in range(60):
        drawn.append(set())
        person.wait(FRAME)
    pages, feet = (sum(kind in frame for frame in drawn[1:]) for kind in ("page", "foot"))

    assert {"page", "foot"} not in drawn[1:]
    assert 8 <= pages <= 11
    assert abs(pages - feet) <= 1
