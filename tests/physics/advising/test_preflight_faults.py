"""What speaks against a level before it runs, and for which values of its parameters."""

from typing import Any

import pytest

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.model.rules.level_validation import corners
from sandbox.physics.advising import preflight_faults
from sandbox.physics.advising.preflight_faults import refusal
from sandbox.physics.scene.make_scene import make_scene
from tests.physics.scenes import GRAVITY, disc, floor, level

CONTACT = {**GRAVITY, "contact": {}}
FAST = {"v": {"value": 1, "min": 0, "max": 2}, "y": {"value": 1, "min": 0.2, "max": 3}}


def thrown(height: str) -> dict[str, Any]:
    """Return a disc of 0.5 m that begins at some height, as fast as `v` says."""
    return {**disc(radius=0.5), "position": [0, height], "velocity": [0, "v"]}


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[Values]:
    """The values with which scenes are made from now on."""
    values: list[Values] = []

    def make(scene: Level, chosen: Values, stepping: Stepping) -> object:
        values.append(chosen)
        return make_scene(scene, chosen, stepping)

    monkeypatch.setattr(preflight_faults, "make_scene", make)
    return values


def test_bodies_that_overlap_at_an_end_of_a_range_are_refused_with_that_value() -> None:
    scene = level(
        {"ball": thrown("y"), "floor": floor(0)},
        CONTACT, parameters=FAST,
    )  # fmt: skip

    error = refusal(scene)

    assert error is not None
    assert "when y = 0.2" in str(error)
    assert "v =" not in str(error)


def test_how_fast_a_body_begins_is_not_varied_where_only_places_matter(
    made: list[Values],
) -> None:
    scene = level(
        {"ball": thrown("y + 1"), "floor": floor(-1)},
        CONTACT, parameters=FAST,
    )  # fmt: skip

    assert refusal(scene) is None
    assert {(values["y"], values["v"]) for values in made} == {(1, 1), (0.2, 1), (3, 1)}


def test_it_is_where_a_drag_grows_with_the_speed(made: list[Values]) -> None:
    scene = level(
        {"ball": thrown("y")},
        {**GRAVITY, "drag": {"quadratic": 0.1}}, parameters=FAST,
    )  # fmt: skip

    assert refusal(scene) is None
    assert {values["v"] for values in made} == {0, 1, 2}


def test_masses_are_tried_only_where_the_rate_may_depend_on_them(made: list[Values]) -> None:
    masses = {"m": {"value": 1, "min": 0.1, "max": 10}}
    ball = {**disc(radius=0.5), "mass": "m", "position": [0, 3]}
    scene = {"ball": ball, "floor": floor(0)}
    assert refusal(level(scene, CONTACT, parameters=masses)) is None
    assert len(made) == 1
    drag = {**CONTACT, "drag": {"linear": 0.1}}
    assert refusal(level(scene, drag, parameters=masses)) is None
    assert len(made) == 1 + 3


def test_the_value_that_causes_a_refusal_is_found_by_halves(made: list[Values]) -> None:
    """2,000 bodies with 20 parameters took 5.8 s, as each parameter was put back by itself."""
    names = [f"y{i}" for i in range(16)]
    ranges = {name: {"value": 1, "min": 0.2 if name == "y5" else 0.9, "max": 3} for name in names}
    bodies = {
        name: {**thrown(name), "position": [3 * i, name], "velocity": [0, 0]}
        for i, name in enumerate(names)
    }
    scene = level({**bodies, "floor": floor(0)}, CONTACT, parameters=ranges)

    error = refusal(scene)

    assert "when y5 = 0.2;" in f"{error};"
    sought = made[len(list(corners(scene))) :]
    assert 0 < len(sought) <= 10
