"""The drawing shows what a surface does: it lets bodies through, or throws them back."""

import json
from math import tau
from typing import Any

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.stage import bodies, joints, static_bodies, strings
from sandbox.app.stage.body_outlines import outlines
from sandbox.app.stage.stage import Stage
from sandbox.model.joints import AngleStop, Stop
from sandbox.model.shapes import XY
from tests.physics.scenes import disc, fixed, level

SIZE = (400, 300)


def count(surface: pygame.Surface, color: Color) -> int:
    return int((pygame.surfarray.array3d(surface) == color).all(axis=2).sum())


@pytest.mark.parametrize("kind", ["static", "kinematic"])
@pytest.mark.parametrize(("hand", "below"), [("left", True), ("right", False)])
def test_a_one_way_line_has_arrowheads_on_the_side_that_it_lets_through_from(
    kind: str, hand: str, below: bool
) -> None:
    line = {"type": "segment", "start": [-3, 0], "end": [3, 0]}
    spec = {**fixed(line, one_way=hand), "type": kind, "color": "#102030"}
    scene = level({"ball": disc((0, 3)), "line": spec}, {"contact": {}})
    outline = outlines(scene, {})["line"]
    surface = pygame.Surface(SIZE)
    if kind == "static":
        static_bodies.draw_surface(surface, Camera(SIZE), outline, (0, 0), 0.0, (0, 3))
    else:
        bodies.draw_body(surface, Camera(SIZE), outline, (0, 0), 0.0, spoke=False)

    upper, lower = (surface.subsurface((0, y, SIZE[0], 145)) for y in (0, 155))
    heads = [count(half, theme.SURFACE_EDGE) for half in (upper, lower)]
    assert heads[below] > 100
    assert heads[not below] == 0


STOPS: dict[str, tuple[type[Stop] | type[AngleStop], dict[str, Any], list[XY]]] = {
    "on a way": (
        Stop,
        {"type": "stop", "ends": ["a", [0, 0]], "direction": [1, 0], "range": [-1, 1]},
        [(-1, 0), (1, 0)],
    ),
    "of an angle": (
        AngleStop,
        {"type": "angle_stop", "ends": [[0, 0], "a"], "range": [-1, 1]},
        [(0, 0), (0.5, -0.8), (0.5, 0.8)],
    ),
}


@pytest.mark.parametrize("kind", STOPS)
def test_only_a_stop_that_throws_back_has_a_coil_behind_it(kind: str) -> None:
    model, said, path = STOPS[kind]

    def coils(**more: float) -> int:
        surface = pygame.Surface(SIZE)
        joint = model.model_validate_json(json.dumps({**said, **more}))
        joints.draw_joint(surface, Camera(SIZE), joint, path, slack=False)
        return count(surface, theme.SPRING)

    assert coils() == 0
    assert coils(restitution=0.5) > 20


def test_a_wheel_turns_with_the_string_that_runs_over_it() -> None:
    """By the length of string that has passed, over the radius: a third of a turn looks the same,
    since there are three spokes."""

    def wheel(passed: float) -> pygame.Surface:
        surface = pygame.Surface(SIZE)
        corners = [(100.0, 200.0 + passed), (100.0, 100.0), (300.0, 100.0), (300.0, 250.0)]
        strings.draw_string(surface, corners, slack=True)
        return surface.subsurface((103, 105, 17, 17))

    def apart(passed: float) -> int:
        both = (pygame.surfarray.array3d(each).astype(int) for each in (wheel(0.0), wheel(passed)))
        return int(np.abs(np.subtract(*both)).sum())

    third = tau / 3 * strings.WHEEL
    assert apart(third / 2) > 2000
    assert apart(third) < apart(third / 2) / 4


def test_a_plain_stage_has_neither_grid_nor_rulers(pen: Pen) -> None:
    stage, surface = Stage(pen, SIZE, plain=True), pygame.Surface(SIZE)
    stage.use(Session(level({"ball": disc((0, 0))}, {})).world)
    stage.fit()
    stage.draw(surface)
    rows = pygame.surfarray.array3d(surface)[:, [0, 20, -20, -1]]

    assert (rows == rows[:1]).all()
