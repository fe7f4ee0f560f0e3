"""Which parameters are used as whole numbers only."""

import pytest

from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.model.whole_number_parameters import acts_as_whole_number
from tests.app import scenes


@pytest.mark.parametrize("name", ["momentum/cradle", "lagrange/chain-of-springs"])
def test_a_number_of_balls_or_of_a_mode_is_whole_and_gravity_is_not(name: str) -> None:
    level = load(level_catalog.find(name))

    assert {p for p in level.parameters if acts_as_whole_number(level, p)} == {"n"}


@pytest.mark.parametrize(
    ("formula", "whole"),
    [
        ("2*floor(n)", True),
        ("5 if n >= 2 else 1", True),
        ("5 if n >= 2.5 else 1", False),
        ("n", False),
        ("floor(n) + n", False),
        ("floor(2*n)", False),
    ],
)
def test_a_parameter_is_whole_if_it_is_only_rounded_or_compared(formula: str, whole: bool) -> None:
    number = {"value": 2, "min": 1, "max": 4}
    level = scenes.level(parameters={"g": number, "mass": number, "n": number}, duration=formula)

    assert acts_as_whole_number(level, "n") is whole
