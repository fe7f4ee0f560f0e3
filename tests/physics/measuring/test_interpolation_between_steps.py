"""Between two steps."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sandbox.physics.measuring.interpolation_between_steps import crossing, value_at

T = np.arange(20) / 7
NUMBER = st.floats(-10, 10)


@given(NUMBER, NUMBER, NUMBER, st.floats(0, T[-1]))
def test_the_value_on_a_parabola_is_exact(a: float, b: float, c: float, at: float) -> None:
    expected = a + b * at + c * at**2

    assert value_at(T, a + b * T + c * T**2, at) == pytest.approx(expected, abs=1e-12)


@given(NUMBER, NUMBER, NUMBER, NUMBER, st.floats(T[3], T[-1]))
def test_the_value_on_a_cubic_is_exact_once_four_samples_are_there(
    a: float, b: float, c: float, d: float, at: float
) -> None:
    samples, expected = a + b * T + c * T**2 + d * T**3, a + b * at + c * at**2 + d * at**3

    assert value_at(T, samples, at) == pytest.approx(expected, abs=1e-11)


@given(st.lists(NUMBER, min_size=6, max_size=6), st.floats(T[0], T[-1]))
def test_where_all_is_smooth_the_value_on_a_quintic_is_exact(terms: list[float], at: float) -> None:
    quintic = np.polynomial.Polynomial(terms)

    found = value_at(T, quintic(T), at, smooth=4)

    assert found == pytest.approx(quintic(at), abs=1e-9)  # of up to 2000


def test_the_value_at_a_sample_is_the_sample() -> None:
    samples = np.random.default_rng(1).normal(size=len(T))

    assert [value_at(T, samples, t) for t in T] == pytest.approx(samples.tolist(), rel=1e-13)


def test_one_sample_is_a_constant() -> None:
    assert value_at(np.zeros(1), np.array([4.0]), 3.0) == 4.0


@given(st.floats(0.01, T[-1]), st.floats(0.5, 20), st.floats(-5, 5))
def test_a_parabola_crosses_where_its_root_is(root: float, g: float, level: float) -> None:
    """A fall from rest reaches a level below its start at √(2 h / g)."""
    fall = level + g * (root**2 - T**2) / 2
    assume(fall[-1] < level)

    assert crossing(T, fall, level, "down") == pytest.approx(root, rel=1e-9)


@pytest.mark.parametrize(
    ("direction", "expected"), [("up", 2 * np.pi), ("down", np.pi), ("either", np.pi)]
)
def test_a_crossing_has_a_direction(direction: object, expected: float) -> None:
    t = np.linspace(0, 7, 701)
    found = crossing(t, np.sin(t), 0.0, direction)  # type: ignore[arg-type]

    assert found == pytest.approx(expected, abs=1e-9)  # h⁴ of the cubic


def test_where_all_is_smooth_a_crossing_is_found_the_better_the_higher_the_order() -> None:
    """Of steps of 1/7, by orders 4 and 8: 4e-11 and 7e-16; the cubic is off by 8e-8."""
    cosine = np.cos(T)

    assert crossing(T, cosine, 0.0, "down", smooth=4) == pytest.approx(np.pi / 2, abs=1e-10)
    assert crossing(T, cosine, 0.0, "down", smooth=8) == pytest.approx(np.pi / 2, abs=1e-14)
    assert crossing(T, cosine, 0.0, "down") != pytest.approx(np.pi / 2, abs=1e-8)


@pytest.mark.parametrize("samples", [[1.0, 2, 3], [0.0, 1, 2], [-1.0, np.nan, 1]])
def test_what_never_crosses_has_no_crossing(samples: list[float]) -> None:
    """Neither does a start on the value itself, nor a gap."""
    assert crossing(np.arange(3.0), np.array(samples), 0.0, "either") is None


def test_a_sample_on_the_value_is_where_it_is_crossed() -> None:
    assert crossing(np.arange(3.0), np.array([-1.0, 0, 1]), 0.0, "up") == pytest.approx(1)


def test_an_impact_right_after_a_crossing_spoils_nothing() -> None:
    """The cubic looks back only: the sample after the crossing may be anything."""
    t = np.arange(10) / 10
    fall = 3 - 9.81 * t**2 / 2
    fall[9:] = 100

    assert crossing(t, fall, 0.0, "down") == pytest.approx(np.sqrt(6 / 9.81), rel=1e-12)


KINK = 9.3 / 7
"""A time between two samples."""

BOUNCE = np.where(T < KINK, 2 - T**2, 2 - KINK**2 + 3 * (T - KINK) - (T - KINK) ** 2)
"""A parabola that turns into another one at the kink, at its lowest point."""


def after(height: float) -> float:
    """When the second parabola reaches a height above the kink on its way up."""
    return KINK + 1.5 - np.sqrt(2.25 - height)


@pytest.mark.parametrize("height", [0.12, 0.3, 0.5, 0.9, 1.4])
def test_a_crossing_soon_after_a_kink_is_on_the_curve_after_it(height: float) -> None:
    """In the step of the kink, and in the next: the cubic was off by up to 0.4 of a step."""
    found = crossing(T, BOUNCE, 2 - KINK**2 + height, "up")

    assert found == pytest.approx(after(height), abs=1e-12)


def test_a_crossing_just_before_a_kink_is_on_the_curve_before_it() -> None:
    found = crossing(T, BOUNCE, 2 - (KINK - 0.02) ** 2, "down", impacts=[KINK])

    assert found == pytest.approx(KINK - 0.02, abs=1e-12)


@pytest.mark.parametrize("at", [KINK - 0.01, KINK + 0.01, KINK + 0.1, KINK + 0.2])
def test_the_value_near_a_kink_is_on_the_curve_on_its_side(at: float) -> None:
    expected = 2 - at**2 if at < KINK else 2 - KINK**2 + 3 * (at - KINK) - (at - KINK) ** 2

    assert value_at(T, BOUNCE, at) == pytest.approx(expected, abs=1e-12)


def test_a_value_that_is_only_crossed_between_two_samples_is_found_at_a_known_impact() -> None:
    level = 2 - KINK**2 + 1e-3  # below every sample
    assert level < BOUNCE.min()
    assert crossing(T, BOUNCE, level, "up") is None

    found = crossing(T, BOUNCE, level, "up", impacts=[0.4, KINK])

    assert found == pytest.approx(after(1e-3), abs=1e-12)


def test_a_jump_is_crossed_at_the_impact_and_what_follows_it_after_it() -> None:
    speed = np.where(T < KINK, -2 * T, 3 - 2 * (T - KINK))

    assert crossing(T, speed, 0.0, "up", impacts=[KINK]) == pytest.approx(KINK, abs=1e-12)
    found = crossing(T, speed, 2.9, "down", impacts=[KINK])
    assert found == pytest.approx(KINK + 0.05, abs=1e-12)
    assert value_at(T, speed, T[10]) == speed[10]
