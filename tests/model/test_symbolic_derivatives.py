"""The derivative of an expression is its slope, wherever it has one."""

import numpy as np
import pytest

from sandbox.model.expression_compiler import FUNCTIONS, ExpressionError
from sandbox.model.expressions import Array
from sandbox.model.number_bounds import EnergyInField
from sandbox.model.symbolic_derivatives import RULES

PLACES = np.random.default_rng(1).uniform(0.3, 0.9, (2, 20))


def slope(energy: EnergyInField, variable: str, h: float = 1e-6) -> Array:
    """Return the central difference: h² / 6 of the third slope, and rounding over h."""
    ahead, behind = (
        dict(
            zip(
                "xy",
                PLACES + sign * h * np.array([[variable == "x"], [variable == "y"]]),
                strict=True,
            )
        )
        for sign in (1, -1)
    )
    return (energy.at({"k": 3.0}, ahead) - energy.at({"k": 3.0}, behind)) / (2 * h)


@pytest.mark.parametrize("variable", ["x", "y"])
@pytest.mark.parametrize(
    "source",
    [
        "k*x**2*y - 2/x + (x - y)/(x + k)",
        "x**y + 2**x + (-x)**2",
        "sin(x*y) + cos(x)*tan(y) - asin(x)*acos(y) + atan(x/y)",
        "atan2(y, x)*hypot(x, y) + sqrt(x)*log(y)",
        "exp(-x**2)*tanh(y) + sinh(x)*cosh(y)",
        "abs(x - y) + max(x, 2*y)*min(x, y) + sign(x - y)*x",
        "where(x < y, x**2, y) + (x if x < 0.5 else y*x) + (x % 0.25)*floor(4*y) - ceil(x)",
        "k + +pi*(not x < y)",
    ],
)
def test_the_derivative_is_the_slope(source: str, variable: str) -> None:
    energy = EnergyInField(source)
    found = energy.slope(variable).at({"k": 3.0}, dict(zip("xy", PLACES, strict=True)))

    assert np.broadcast_to(found, 20) == pytest.approx(slope(energy, variable), abs=2e-8, rel=2e-8)


def test_every_function_has_a_derivative() -> None:
    assert FUNCTIONS.keys() <= RULES.keys()


def test_what_a_constant_factor_makes_zero_is_left_out() -> None:
    """Otherwise 0 · ∞ has no value: the derivative of 1/y by x is 0 even where y is 0."""
    assert EnergyInField("1/y").slope("x").at({}, {"y": np.zeros(1)}) == 0


@pytest.mark.parametrize(("source", "smooth"), [("x**2 - cos(y)", True), ("abs(x)", False)])
def test_corners_are_seen(source: str, smooth: bool) -> None:
    assert EnergyInField(source).is_smooth is smooth


def test_what_is_nested_too_deeply_is_told() -> None:
    with pytest.raises(ExpressionError, match="nested too deeply to be differentiated"):
        EnergyInField("*".join(["x"] * 240)).slope("x")
