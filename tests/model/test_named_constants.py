"""Constants name formulas, and change nothing else of a level."""

import pickle

import numpy as np
import pytest

from sandbox.model.expressions import Expression
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import including
from sandbox.physics.run import build
from tests.model.levels import Data, bare, level, mistakes


def named(**constants: object) -> Data:
    return bare() | {
        "constants": constants,
        "bodies": {"ball": {"shape": {"type": "disc", "radius": "size"}, "mass": "m"}},
    }


def test_a_constant_may_use_parameters_and_constants_in_any_order() -> None:
    radius = level(named(size="2*half", half="m/4 + pi")).bodies["ball"].shape.radius  # type: ignore[union-attr]

    assert radius.names == {"m"}, "what it depends on are parameters"
    assert radius({"m": 2.0}) == 2 * (0.5 + np.pi)
    assert radius.source == "size", "it stays as it is typed"


def test_a_level_with_constants_moves_to_the_bits_of_the_one_without() -> None:
    short = named(size="half/2", half=1) | {"checks": []}
    short["constants"]["pull"] = "g*1.7"
    short["effects"] = {"gravity": {"acceleration": ["pull/3", "-pull"]}}
    long = bare() | {"checks": []}
    long["effects"] = {"gravity": {"acceleration": ["(g*1.7)/3", "-(g*1.7)"]}}
    states = [build(level(data)).advance(60) for data in (short, long)]

    assert np.array_equal(states[0].position, states[1].position)


def test_a_formula_over_time_takes_constants_as_well() -> None:
    data = named(size="1", way="g/2")
    data["checks"][0]["formula"] = "-way*t**2"
    formula = level(data).checks[0].formula

    assert formula.names == {"g", "t"}
    assert formula.over({"g": 10.0}, np.array([0.0, 2.0])).tolist() == [0, -20]


def test_a_level_keeps_its_constants_on_the_way_to_another_process() -> None:
    there = pickle.loads(pickle.dumps(level(named(size="2*half", half="m/4"))))

    assert there.bodies["ball"].shape.radius({"m": 2.0}) == 1
    again = Level.model_validate_json(there.model_dump_json(by_alias=True, exclude_none=True))
    assert again.bodies["ball"].shape.radius({"m": 2.0}) == 1  # type: ignore[union-attr]


def test_an_effect_that_is_switched_on_may_use_them() -> None:
    found = including(level(named(size="m/4")), "drag", {"linear": "size"})

    assert found.effects.drag
    assert found.effects.drag.linear is not None
    assert found.effects.drag.linear({"m": 2.0}) == 0.5


@pytest.mark.parametrize(
    ("constants", "path", "rule"),
    [
        ({"size": "2*a", "a": "b", "b": "a"}, "constants.a", "depends on itself: a -> b -> a"),
        (
            {"size": "c0", **{f"c{i}": f"c{(i + 1) % 150}" for i in range(150)}},
            "constants.c0",
            "depends on itself: c0 -> c1 -> c2 -> … -> c149 -> c0; constants",
        ),
        ({"size": "size"}, "constants.size", "depends on itself: size -> size"),
        ({"size": 1, "a": 2}, "constants.a", "'a' is declared but nothing uses it"),
        ({"size": "q"}, "constants.size", "unknown parameter 'q'"),
        ({"size": "t"}, "constants.size", "the time 't' has no meaning here"),
        ({"size": "m", "m": 1}, "constants.m", "is already the name of a parameter"),
        ({"size": 1, "s": 1}, "constants.s", "already has a meaning in formulas"),
        ({"size": 1, "sin": 1}, "constants.sin", "already has a meaning in formulas"),
        ({"size": "1/(m - 1)"}, "constants.size", "is inf, not a finite number when m = 1"),
        ({"size": "a - 2", "a": 1}, "bodies.ball.shape.radius", "'size' is -1, but must be"),
        ({"size": "m - 3"}, "bodies.ball.shape.radius", "must be greater than 0 when m = 2"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_at_its_place(constants: Data, path: str, rule: str) -> None:
    told = [mistake.rule for mistake in mistakes(named(**constants)) if mistake.path == path]

    assert any(rule in one for one in told), told


def test_doubling_two_hundred_times_takes_no_time() -> None:
    """Written out, the last formula would be longer than any memory."""
    double = {f"a{i}": f"a{i - 1} + a{i - 1}" for i in range(1, 199)}
    found = level(named(a0="m/2", **double, size="a198/2**198"))

    assert found.bodies["ball"].shape.radius({"m": 2.0}) == 1  # type: ignore[union-attr]


def test_an_expression_without_constants_is_none_the_wiser() -> None:
    plain = Formula("2*m*t")

    assert plain.names == plain.names_written == {"m", "t"}
    assert pickle.loads(pickle.dumps(plain)) == plain
    assert Expression("2*m")({"m": 1.5}) == 3
