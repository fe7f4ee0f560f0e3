"""Integrals as functions of their upper limit."""

from collections.abc import Callable
from math import cos, expm1, floor, isnan, nan

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.functions_of_one_variable import Formula
from sandbox.physics.geometry.quadrature import Antiderivative

TIMES = (0.0, 1e-3, 0.25, 1.0, 1.04, 1.0999, 2.6, 3.0, 7.7, 40.3)


def integral(formula: str) -> Antiderivative:
    return Antiderivative(lambda t: Formula(formula).over({}, t))


@pytest.mark.parametrize(
    ("formula", "exact"),
    [
        ("sin(3*t)", lambda t: (1 - cos(3 * t)) / 3),
        ("1 - exp(-3*t)", lambda t: t + expm1(-3 * t) / 3),
        ("sin(1000*t)", lambda t: (1 - cos(1000 * t)) / 1000),
        ("where(t < 1.03, 1, -2)", lambda t: min(t, 1.03) - 2 * max(t - 1.03, 0)),
        ("where(t >= 1 and t < 1.002, 100, 0)", lambda t: 100 * min(max(t - 1, 0), 0.002)),
        ("abs(t - 1.03)", lambda t: (1.03**2 + abs(t - 1.03) * (t - 1.03)) / 2),
        ("t % 0.3", lambda t: floor(t / 0.3) * 0.045 + (t % 0.3) ** 2 / 2),
        ("sqrt(1.1 - t)", lambda t: (1.1**1.5 - (1.1 - t) ** 1.5) / 1.5 if t < 1.1 else nan),
    ],
)
def test_an_integral_is_exact_to_rounding_with_jumps_corners_and_short_pulses(
    formula: str, exact: Callable[[float], float]
) -> None:
    """Measured: 3e-14 at most, for the pulse."""
    found = integral(formula)
    for t in TIMES:
        assert found(t) == pytest.approx(exact(t), rel=1e-13, abs=1e-13, nan_ok=True)


@pytest.mark.parametrize("formula", ["sin(3*t)", "where(t < 1.03, t, -2)", "sqrt(1.1 - t)"])
def test_an_integral_has_the_same_bits_whatever_was_asked_for_before(formula: str) -> None:
    forwards, backwards = integral(formula), integral(formula)
    first = [forwards(t) for t in TIMES]
    second = [backwards(t) for t in reversed(TIMES)][::-1]

    assert [x for x in first if not isnan(x)] == [x for x in second if not isnan(x)]
    assert first[:4] == [integral(formula)(t) for t in TIMES[:4]]


@pytest.mark.parametrize("formula", ["sin(3*t)", "sin(1e9*t)", "where(t < 1.03, 1, -2)"])
def test_a_call_evaluates_the_same_number_of_points_at_any_time(formula: str) -> None:
    """Also of a function that is not smooth anywhere."""
    points = list[int]()

    def counted(t: Array) -> Array:
        points.append(t.size)
        return Formula(formula).over({}, t)

    found = Antiderivative(counted)
    found(10.1)
    assert sum(points) < 41 * 80_000  # each panel of noise has 74,240
    points.clear()
    for t in np.linspace(0, 10.1, 50):
        found(float(t))
    assert max(points) == 16
