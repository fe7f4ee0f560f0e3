"""What stands on its corners at the start is in touch, whichever way it leans."""

from math import cos, hypot, radians, sin, tan

import pytest

from sandbox.physics.run import build as make
from sandbox.physics.scene import contact_setup
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, box, fixed, floor, level

LENGTH, WIDTH = 4.0, 0.1


def ladder(angle: float) -> World:
    """Lean a ladder on a smooth wall, by its corners: the floor is rough enough."""
    a = radians(angle)
    height = (LENGTH * sin(a) + WIDTH * cos(a)) / 2
    reach = (LENGTH * cos(a) + WIDTH * sin(a)) / 2
    wall = fixed({"type": "box", "width": 1, "height": 20}, (reach + 0.5, 0), friction=0)
    bodies = {
        "ladder": box((0, height), size=(LENGTH, WIDTH), angle=a, friction=1, mass=10),
        "wall": wall,
        "floor": floor(friction=2),
    }
    effects = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
    return make(level(bodies, effects, stepping={"rate": 240}))


@pytest.mark.parametrize("angle", [50, 57, 63, 71, 80, 88])
def test_a_ladder_stands_from_the_first_step_on(angle: float) -> None:
    world = ladder(angle)
    start = world.snapshot
    for _ in range(5):
        now = world.advance()
        moved = hypot(*(now.position[0] - start.position[0]))
        assert moved <= 1e-12
        assert now.normal[2] == pytest.approx(10 * G, rel=1e-9)


@pytest.mark.parametrize("solver", ["iterative", "direct"])
@pytest.mark.parametrize("angle", [11, 20, 34, 90, 150])
def test_what_lies_on_edges_presses_on_them_at_once(angle: float, solver: str) -> None:
    half, height = radians(angle) / 2, 0.5
    foot = height * tan(half)
    edge = {"type": "polygon", "vertices": [[-foot, 0], [foot, 0], [0, height]]}
    bodies = {
        "block": box((0, height + 0.1), size=(4, 0.2), mass=10),
        "left": fixed(edge, (-1, 0)),
        "right": fixed(edge, (1.5, 0)),
    }
    effects = {**GRAVITY, "contact": {"solver": solver}, "rotation": {}}
    world = make(level(bodies, effects, stepping={"rate": 240}))

    assert world.snapshot.normal[1:] == pytest.approx([60 * G / 10, 40 * G / 10], rel=1e-6)
    assert abs(world.advance(3).position[0, 1] - height - 0.1) <= 1e-9


@pytest.mark.parametrize("angle", [3, 5, 11, 20])
def test_a_knife_stands_on_its_edge_from_the_first_step_on(angle: float) -> None:
    """Its rounding left it 2e-7 m short at 11°: it fell by 1.4 mm in the first step."""
    half = tan(radians(angle) / 2)
    edge = {"type": "polygon", "vertices": [[0, 0], [half, 1], [-half, 1]]}
    bodies = {"knife": {"shape": edge, "mass": 1, "position": [0, 2 / 3]}, "floor": floor()}
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "rotation": {}}
    world = make(level(bodies, effects, stepping={"rate": 60}))

    assert abs(world.advance(3).position[0, 1] - 2 / 3) <= 1e-8


def test_without_prouder_corners_it_falls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contact_setup, "reach_out", lambda _space: None)
    world = ladder(63)
    start = world.snapshot.position[0, 1]

    assert start - world.advance().position[0, 1] > 5e-5
