"""During a long step the window says so, continues to draw, and Esc stops it."""

import json
from collections.abc import Callable
from pathlib import Path

import pygame
import pytest

from sandbox.app import responding_during_long_frames
from sandbox.app.drawing import theme
from sandbox.model.many_body_level_generator import crowd
from tests.app import scenes
from tests.app.person import FRAME, Person

Act = Callable[[], object]


@pytest.fixture
def heap(person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Person:
    """A person in front of a heap whose contacts take longer to solve than anybody waits."""
    monkeypatch.setattr(responding_during_long_frames, "LONG", 0.0)
    monkeypatch.setattr(responding_during_long_frames, "AGAIN", 0.0)
    level = crowd("pile", 5)
    effects = {**level["effects"], "contact": {"solver": "direct"}}
    person.open(tmp_path, json.dumps({**level, "effects": effects}))
    person.session.do_again((), 10)
    return person


def shown(monkeypatch: pytest.MonkeyPatch, *acts: Act) -> list[pygame.Surface]:
    """Return the pictures that will be shown within frames; actions follow the first of them."""
    pictures: list[pygame.Surface] = []
    to_do = list(acts)

    def flip() -> None:
        surface = pygame.display.get_surface()
        assert surface is not None
        pictures.append(surface.copy())
        if to_do:
            to_do.pop(0)()

    monkeypatch.setattr(pygame.display, "flip", flip)
    return pictures


def post(key: int, text: str = "") -> Act:
    event = pygame.Event(pygame.KEYDOWN, key=key, unicode=text, mod=0, scancode=0)
    return lambda: pygame.event.post(event)


def step(person: Person) -> None:
    """Take one step, and no frame after it."""
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_PERIOD, unicode=".", mod=0))
    person.window.frame(FRAME)


def test_a_step_that_takes_long_is_told_of_while_it_lasts(
    heap: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    pictures = shown(monkeypatch)
    before = heap.session.world.steps

    step(heap)

    assert heap.session.world.steps == before + 1
    assert heap.session.failure is None
    area = heap.window.panels.layout.stage
    edge = [p.get_at((x, y))[:3] for p in pictures for x, y in [area.center] for y in (y + 14,)]
    assert len(pictures) > 1
    assert theme.NOTICE in edge


def test_escape_stops_the_step_and_the_window_stays(
    heap: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown(monkeypatch, post(pygame.K_ESCAPE))

    step(heap)

    assert str(heap.session.failure).startswith("stopped by Esc after ")
    heap.wait()
    assert heap.window.open
    heap.press(pygame.K_r, "r")
    assert (heap.session.failure, heap.session.world.steps) == (None, 0)


def test_closing_the_window_stops_the_step(heap: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    shown(monkeypatch, lambda: pygame.event.post(pygame.Event(pygame.QUIT)))

    step(heap)

    assert not heap.window.open


def test_what_else_happens_meanwhile_happens_after_the_step(
    heap: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The window is made smaller, and another page is requested."""
    small = (900, 600)

    def resize() -> None:
        pygame.display.set_mode(small, pygame.RESIZABLE)
        pygame.event.post(pygame.Event(pygame.VIDEORESIZE, size=small, w=900, h=600))

    pictures = shown(monkeypatch, resize, post(pygame.K_j, "j"))
    step(heap)
    page = heap.window.panels.page

    heap.wait()

    assert {picture.size for picture in pictures} == {(1280, 800), small}
    assert heap.window.panels.layout.stage.bottom <= small[1]
    assert (page, heap.window.panels.page) == ("level page", "forces page")
    assert heap.session.failure is None


def test_the_way_of_the_mouse_is_added_up(heap: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    def drag() -> None:
        for x in range(1, 6):
            moved = {"pos": (600 + x, 300), "rel": (1, 0), "buttons": (1, 0, 0), "touch": False}
            pygame.event.post(pygame.Event(pygame.MOUSEMOTION, moved))

    shown(monkeypatch, drag)
    step(heap)

    moves = [event for event in heap.window.hold_up.events() if event.type == pygame.MOUSEMOTION]
    assert [(event.pos, event.rel) for event in moves] == [((605, 300), (5, 0))]


def test_a_level_whose_building_is_stopped_is_refused_with_that_sentence(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(responding_during_long_frames, "LONG", 0.0)
    monkeypatch.setattr(responding_during_long_frames, "AGAIN", 0.0)
    boxes = {
        f"box{i}": {
            "shape": {"type": "box", "width": 1, "height": 1}, "mass": 1, "position": [0, i + 0.5],
        }
        for i in range(3)
    }  # fmt: skip
    floor = {"type": "static", "shape": {"type": "segment", "start": [-5, 0], "end": [5, 0]}}
    g = {"g": {"value": 10, "min": 0, "max": 20}}
    tower = scenes.falling(
        effects={"gravity": {"acceleration": [0, "-g"]}, "contact": {}},
        bodies={**boxes, "floor": floor}, parameters=g, checks=[], ghosts={},
    )  # fmt: skip
    path = tmp_path / "tower.json"
    path.write_text(tower, encoding="utf-8")
    shown(monkeypatch, post(pygame.K_ESCAPE))

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.window.frame(FRAME)

    assert person.window.session is None
    person.press(pygame.K_F5)
    assert person.session.level.title == "A falling ball"
