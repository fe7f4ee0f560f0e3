"""No number of a level is too large or too small to compute with."""

from collections.abc import Iterator
from typing import Any

import pytest

from sandbox.model import number_bounds
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression
from sandbox.model.write_json_schema import schema
from tests.model.levels import Data, bare, hanging, mistakes, said, setting

HOME = number_bounds.__name__
KINDS = [
    kind
    for kind in vars(number_bounds).values()
    if isinstance(kind, type) and issubclass(kind, Expression) and kind.__module__ == HOME
]


def test_of_the_largest_numbers_the_largest_product_is_still_a_number() -> None:
    """A mass, four lengths and the square of a spin: nothing multiplies more of them at once."""
    assert number_bounds.Mass.most * number_bounds.Coordinate.most**4 < 1e100
    assert (
        number_bounds.Mass.most * number_bounds.Speed.most**2 * number_bounds.Coordinate.most**2
        < 1e100
    )
    assert (
        number_bounds.Strength.most
        * number_bounds.Mass.most
        * number_bounds.Coordinate.most**number_bounds.Power.most
        < 1e250
    )


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_beyond_its_bound_is_refused_with_value_and_bound(kind: type[Expression]) -> None:
    large = kind.most * 1.01

    with pytest.raises(ExpressionError, match=r"but must be at most .*overflow") as caught:
        kind(large)
    with pytest.raises(ExpressionError, match="overflow"):
        kind(f"{large!r} + 0*x")({"x": 1.0})

    assert f"is {large:g}" in str(caught.value)
    assert f"{kind.most:g}" in str(caught.value)
    assert kind(kind.most)({}) == kind.most


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.least])
def test_a_number_too_small_to_be_squared_is_refused(kind: type[Expression]) -> None:
    with pytest.raises(ExpressionError, match=r"but must be at least .*underflow"):
        kind(kind.least / 2)


def _numbers(part: Any) -> Iterator[dict[str, Any]]:  # noqa: ANN401 (whatever JSON holds)
    if isinstance(part, dict):
        if "number" in part.get("type", ()):
            yield part
        part = list(part.values())
    for child in part if isinstance(part, list) else ():
        yield from _numbers(child)


def test_the_schema_tells_the_bounds_of_every_number() -> None:
    for part in _numbers(schema()):
        assert {"maximum", "exclusiveMaximum"} & part.keys() or part["title"] == "Tolerance"


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        ("bodies.ball.mass", 5e-324, "bodies.ball.mass: is 4.94066e-324 kg, but must be at least"),
        ("bodies.ball.mass", "m*10**-40", "'m*10**-40' is 2e-40 kg, but must be at least 1e-35"),
        ("bodies.ball.position", [1e16, 0], "is 1e+16 m, but must be at most 1e+15 m"),
        ("bodies.ball.velocity", [0, -1e13], "is -1e+13 m/s, but must be at least -1e+12 m/s"),
        ("duration", 1e300, "duration: is 1e+300 s, but must be at most 1e+12 s"),
        ("effects.gravity.acceleration", [0, 1e16], "but must be at most 1e+15 m/s²"),
        ("parameters.m.max", 1e200, "parameters.m.max: must be at most 1e+100"),
    ],
)
def test_a_level_with_a_number_beyond_its_bound_is_refused(
    path: str, value: object, expected: str
) -> None:
    assert any(expected in mistake for mistake in said(mistakes(bare(), setting(path, value))))


def test_a_line_too_long_to_have_a_moment_of_inertia_is_refused() -> None:
    """Chipmunk ends the process if a moment of inertia is not a number."""
    data = bare()
    data["effects"]["rotation"] = {}
    data["bodies"]["ball"]["angular_velocity"] = 1
    data["bodies"]["ball"]["shape"] = {
        "type": "polyline",
        "points": [[0, 0], [1e155, 0], [1e155, 1e155]],
    }

    assert "points.1.0: is 1e+155 m, but must be at most 1e+15 m" in said(mistakes(data))[0]


@pytest.mark.parametrize(
    ("field", "value"), [("force", [0, "1e50*t"]), ("force", ["exp(500*t)", 0])]
)
def test_a_force_that_grows_beyond_its_bound_is_told_with_the_time(
    field: str, value: list[object]
) -> None:
    data = bare()
    data["effects"]["force"] = [{"body": "ball", field: value}]

    (found,) = said(mistakes(data))

    assert " N at t = " in found
    assert "but must be at most 1e+40 N" in found


def test_a_rod_of_a_length_beyond_its_bound_is_told() -> None:
    data: Data = hanging()
    data["joints"] = {"rod": {"type": "rod", "ends": ["ball", "other"], "length": "2 + 1e20*t"}}

    assert any("must be at most 1e+15 m" in mistake for mistake in said(mistakes(data)))
