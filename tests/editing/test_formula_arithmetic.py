"""Formulas shifted, scaled, negated and renamed say what they should, and stay readable."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.editing.formula_arithmetic import negative, renamed, rotated, scaled, shifted
from sandbox.model.expressions import Expression

VALUES = {"a": 1.7, "b": 0.3}
SOURCES = [
    2,
    -0.5,
    "a",
    "-a",
    "a + 1",
    "a - 1.5",
    "(a + 1)",
    "(a + b) + 2",
    "a*(b + 1)",
    "a - (b - 1)",
    "2*pi",
    "-(a + b)",
    "-a*b",
    "-a**2",
    "a if a > b else b",
    "a < b",
    "-(a)*(b)",
    "30*deg",
    "1e-3 + a - 2e-3",
]


@pytest.mark.parametrize("source", SOURCES)
@given(st.floats(-10, 10).map(lambda x: round(x, 3)))
def test_what_is_done_to_a_formula_is_done_to_its_value(source: float | str, by: float) -> None:
    before = Expression(source)
    value = before(VALUES)
    assert Expression(shifted(before, by))(VALUES) == pytest.approx(value + by, abs=1e-12)
    assert Expression(scaled(before, by))(VALUES) == pytest.approx(value * by, abs=1e-12)
    assert Expression(negative(before))(VALUES) == pytest.approx(-value, abs=1e-12)
    assert Expression(rotated(before, by))(VALUES) == pytest.approx(value + by, abs=2e-12)


@pytest.mark.parametrize(
    ("source", "by", "told"),
    [
        ("r", 0.5, "r + 0.5"),
        ("r + 0.5", 0.25, "r + 0.75"),
        ("r + 0.5", -0.75, "r - 0.25"),
        ("r - 0.5", 0.5, "r"),
        ("2*(r + 1)", 1, "2*(r + 1) + 1"),
        (0.1, 0.2, 0.3),
    ],
)
def test_a_formula_that_is_shifted_can_still_be_read(
    source: float | str, by: float, told: float | str
) -> None:
    assert shifted(Expression(source), by) == told


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("-g", "g"),
        ("g", "-g"),
        ("-(a + b)", "a + b"),
        ("a + b", "-(a + b)"),
        ("-a*deg", "a*deg"),
        ("a*deg", "-(a*deg)"),
        ("-a*b + c", "-(-a*b + c)"),
        ("(-a + b)*c", "-((-a + b)*c)"),
    ],
)
def test_the_opposite_of_a_formula_can_still_be_read(source: str, told: str) -> None:
    assert negative(Expression(source)) == told


def test_only_the_whole_of_a_name_is_renamed() -> None:
    assert (
        renamed("e + e1 + exp(e) + 1e5 + some_e*e", "e", "k") == "k + e1 + exp(k) + 1e5 + some_e*k"
    )
