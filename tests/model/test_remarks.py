"""Effects that are declared, and have no strength whatever the parameters are, are told."""

from typing import Any

import pytest

from sandbox.model import catalog
from sandbox.model.loading import load
from sandbox.model.remarks import remarks
from tests.model.levels import bare, level, setting, touching

NOTHING: dict[str, Any] = {
    "gravity": {"acceleration": [0, "0*2"]},
    "attraction": [{"mu": 1}, {"mu": 0}],
    "gravitation": {"constant": 0},
    "centrifugal": {"rate": 0},
    "force": [{"body": "ball", "force": [0, 0]}],
    "thrust": [{"body": "ball", "exhaust": [0, 0], "rate": 1, "propellant": 0.5}],
}


@pytest.mark.parametrize("name", NOTHING)
def test_an_effect_without_strength_is_told(name: str) -> None:
    ball = bare()["bodies"]["ball"] | {"mass": 1, "position": [1, 0]}
    bodies = {"ball": ball, "other": {**ball, "position": [9, 0]}}
    data = {"format": 1, "title": "Still", "effects": {name: NOTHING[name]}, "bodies": bodies}

    (found,) = remarks(level(data))

    assert found.path[:2] == ("effects", name)
    assert found.rule.startswith(f"'{name}' has no strength")


@pytest.mark.parametrize("name", ["friction", "restitution"])
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
    assert list(remarks(load(catalog.find(name)))) == []


@pytest.mark.parametrize(
    ("condition", "told"),
    [
        ("1 > 2", "the check never applies: it does not hold"),
        ("m > 4", "does not hold with the default values, nor at the parameters' bounds"),
        ("sqrt(m - 9) > 0", "does not hold with the default values, nor at the parameters' bounds"),
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
