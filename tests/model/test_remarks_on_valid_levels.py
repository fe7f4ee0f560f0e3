"""Declared effects that have no strength for any parameters are reported."""

import pytest

from sandbox.model import level_catalog
from sandbox.model.body import Body
from sandbox.model.effects import EFFECTS
from sandbox.model.loading import load
from sandbox.model.remarks_on_valid_levels import remarks
from tests.effects import idle
from tests.model.levels import bare, level, setting, touching
from tests.physics import scenes
from tests.physics.scenes import GRAVITY

STRONG = [effect.name for effect in EFFECTS.values() if effect.strength and effect.is_force]


@pytest.mark.parametrize("name", STRONG)
def test_an_effect_without_strength_is_told(name: str) -> None:
    ball = bare()["bodies"]["ball"] | {"mass": 2, "position": [1, 0]}
    bodies = {"a": ball, "b": {**ball, "position": [9, 0]}}
    effects = {name: idle(name), **({"rotation": {}} if EFFECTS[name].exerts_torque else {})}
    data = {"format": 1, "title": "Still", "effects": effects, "bodies": bodies}

    (found,) = remarks(level(data))

    assert found.path[:2] == ("effects", name)
    assert found.path[-1] in EFFECTS[name].strength
    assert found.rule.startswith(f"'{name}' has no strength")


def test_a_belt_without_speed_is_told() -> None:
    data = touching()
    data["effects"]["belt"] = [{"body": "floor", "velocity": [0, "0*2"]}]

    (found,) = remarks(level(data))

    assert found.path == ("effects", "belt", 0, "velocity")


@pytest.mark.parametrize("name", [n for n, effect in EFFECTS.items() if effect.coefficient])
def test_surfaces_whose_coefficients_are_all_zero_are_told(name: str) -> None:
    data = touching()
    for body in data["bodies"].values():
        body[name] = 0

    (found,) = remarks(level(data))

    assert found.path == ("effects", name)


def test_a_parameter_may_be_zero() -> None:
    assert list(remarks(level(bare()))) == []
    assert list(remarks(level(touching()))) == []


@pytest.mark.parametrize("name", ["newton/atwood", "momentum/cradle", "newton/conveyor-belt"])
def test_the_levels_declare_nothing_for_nothing(name: str) -> None:
    assert list(remarks(load(level_catalog.find(name)))) == []


@pytest.mark.parametrize(
    ("condition", "told"),
    [
        ("1 > 2", "the check never applies: its condition is false"),
        ("m > 4", "condition is false with the default values and at the parameters' bounds"),
        (
            "sqrt(m - 9) > 0",
            "condition is false with the default values and at the parameters' bounds",
        ),
        ("m > 3", None),
        ("g == 0", None),
        ("m == 2", None),
    ],
)
def test_a_check_that_never_applies_is_told(condition: str, told: str | None) -> None:
    found = list(remarks(level(bare(), setting("checks.0.valid_if", condition))))

    assert [(fault.path, fault.rule.endswith(told or "")) for fault in found] == (
        [(("checks", 0, "valid_if"), True)] if told else []
    )


@pytest.mark.parametrize("events", [{}, {"cut": {"at": 1, "cut": ["pin"]}}])
def test_a_stop_that_rebounds_less_exactly_is_told(events: dict[str, object]) -> None:
    stop = {"type": "angle_stop", "ends": [[0, 0], "flap"], "range": [-0.5, 0.5]}
    joints = {
        "pin": {"type": "pivot", "ends": [[0, 0], "flap"]},
        "stop": {**stop, "restitution": 0.5},
    }
    effects = {**GRAVITY, "contact": {}, "rotation": {}}
    bodies = {"flap": scenes.box(), "ball": scenes.disc((0, 2))}
    this = scenes.level(bodies, effects, joints=joints, events=events)

    told = [(fault.path, "less exactly" in fault.rule) for fault in remarks(this)]
    assert told == ([(("joints", "stop", "restitution"), True)] if events else [])


def test_bodies_are_not_asked_for_what_they_cannot_have(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of 2,000 rockets asked each of 2,000 bodies for a coefficient: 8 s."""
    torsion = [{"body": "ball", "stiffness": 1} for _ in range(5)]
    effects = {"rotation": {}, "torsion": torsion}
    ball = {**bare()["bodies"]["ball"], "mass": 2}
    made = level({"format": 1, "title": "x", "effects": effects, "bodies": {"ball": ball}})
    asked: list[str] = []

    def missing(_: Body, name: str) -> None:
        asked.append(name)
        raise AttributeError(name)

    monkeypatch.setattr(Body, "__getattr__", missing, raising=False)

    assert list(remarks(made)) == []
    assert asked == []
