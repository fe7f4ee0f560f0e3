"""Labels, hidden bodies and layers are drawn, and affect nothing else."""

import json
from typing import Any

import numpy as np
import pygame
import pytest

from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.run import build

SIZE = (400, 300)
RED, BLUE = (255, 0, 0), (0, 0, 255)


def level(red: Any = (), blue: Any = (), **view: Any) -> Level:  # noqa: ANN401
    """Two boxes at one place; the red one comes first in the file."""
    box = {"shape": {"type": "box", "width": 4, "height": 3}, "mass": 1}
    return parse(json.dumps({
        "format": 1, "title": "x", "effects": {"gravity": {"acceleration": [0, -1]}},
        "bodies": {"red": {**box, "color": "#ff0000", **dict(red)},
                   "blue": {**box, "color": "#0000ff", **dict(blue)}},
        "view": {"width": 10, **view},
    }))  # fmt: skip


def drawn(found: Level, pen: Pen) -> pygame.Surface:
    stage = Stage(pen, SIZE)
    stage.use(Session(found).world)
    stage.fit()
    stage.shown = dict.fromkeys(stage.shown, False)
    surface = pygame.Surface(SIZE)
    stage.draw(surface)
    return surface


def color(surface: pygame.Surface) -> tuple[int, ...]:
    return tuple(surface.get_at((SIZE[0] // 2 + 30, SIZE[1] // 2 + 20)))[:3]


def test_what_is_typed_later_lies_in_front_unless_a_layer_says_otherwise(pen: Pen) -> None:
    assert color(drawn(level(), pen)) == BLUE
    assert color(drawn(level(red={"layer": 1}), pen)) == RED
    assert color(drawn(level(blue={"layer": -1}), pen)) == RED


def test_what_is_hidden_is_not_drawn_and_not_taken_hold_of(pen: Pen) -> None:
    found = level(blue={"hidden": True})
    stage = Stage(pen, SIZE)
    stage.use(Session(found).world)
    stage.fit()

    assert color(drawn(found, pen)) == RED
    assert stage.body_at((SIZE[0] / 2, SIZE[1] / 2)) == "red"


def test_a_sensor_is_a_veil_over_what_is_in_it(pen: Pen) -> None:
    """Whatever is behind it is visible, in another colour than elsewhere."""
    sensor = {"type": "static", "sensor": True, "mass": None, "layer": 1}
    small = {"shape": {"type": "disc", "radius": 0.5}, "position": [1, 0]}
    picture = drawn(level(small, sensor, center=[0, 0]), pen)
    red, veil, bare = (picture.get_at(at)[:3] for at in ((240, 150), (180, 150), (60, 150)))

    assert red[0] > 150
    assert veil[2] > bare[2] + 10
    assert veil[0] < 60


def test_a_still_body_is_raised_by_its_layer(pen: Pen) -> None:
    for layer, seen in ((0, RED), (1, BLUE)):
        box = {"shape": {"type": "box", "width": 4, "height": 3}}
        data = {
            "format": 1, "title": "x", "effects": {"gravity": {"acceleration": [0, -1]}},
            "bodies": {"red": box | {"mass": 1, "color": "#ff0000"},
                       "blue": box | {"type": "static", "color": "#0000ff", "layer": layer}},
            "view": {"width": 10},
        }  # fmt: skip
        found = color(drawn(parse(json.dumps(data)), pen))
        assert np.argmax(found) == np.argmax(seen)


@pytest.mark.parametrize("at", ["red", {"body": "red", "at": [0, 1]}, [0, 1]])
def test_a_label_is_written_where_it_belongs(pen: Pen, at: object) -> None:
    bare = pygame.surfarray.array3d(drawn(level(), pen))
    labelled = drawn(level(labels=[{"text": "here", "at": at}]), pen)
    changed = np.argwhere((pygame.surfarray.array3d(labelled) != bare).any(axis=2))

    x, y = changed.mean(axis=0)
    assert x == pytest.approx(SIZE[0] / 2, abs=3)
    up = 0 if at == "red" else SIZE[0] / 10
    assert y == pytest.approx(SIZE[1] / 2 - up, abs=3)


@pytest.mark.parametrize("text", ["\u202e\u200b", "x" * 80, "ümlaut ω"])
def test_any_text_can_be_written(pen: Pen, text: str) -> None:
    drawn(level(labels=[{"text": text, "at": [0, 0]}]), pen)


def test_nothing_of_it_touches_the_physics() -> None:
    plain, shown = (
        build(found).advance(30)
        for found in (
            level(), level({"hidden": True}, {"layer": 3}, labels=[{"text": "x", "at": "red"}])
        )
    )  # fmt: skip

    assert np.array_equal(plain.position, shown.position)
    assert np.array_equal(plain.velocity, shown.velocity)


@pytest.mark.parametrize(
    ("view", "told"),
    [
        ({"labels": [{"text": "", "at": "red"}]}, "must not be empty"),
        ({"labels": [{"text": "x" * 81, "at": "red"}]}, "must not be longer than 80"),
        ({"labels": [{"text": "x", "at": "green"}]}, "unknown body 'green'"),
        ({"labels": [{"text": "x"}]}, "'at' is missing"),
        ({"labels": [{"text": "x", "at": [0, 0]}] * 101}, "at most 100"),
    ],
)
def test_a_label_that_cannot_be_is_told(view: dict[str, Any], told: str) -> None:
    with pytest.raises(LevelError, match=told):
        level(**view)
