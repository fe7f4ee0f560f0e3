"""The root of a function of one number."""

from math import cos, inf

import pytest

from sandbox.physics.geometry.root_finding import SecantMethod, root


def test_it_is_where_the_function_falls_to_nothing() -> None:
    assert root(cos, 3.0) == pytest.approx(1.5707963267948966, abs=1e-13)
    assert root(lambda x: 1 - x**9, 4.0) == pytest.approx(1.0, abs=1e-13)


def test_what_stays_above_has_none_and_what_begins_below_is_there() -> None:
    assert root(lambda x: 1 + x, 1.0) == inf
    assert root(lambda x: -1 - x, 1.0) == 0.0


def test_a_fall_takes_few_looks() -> None:
    """9 of them; with an end halved at every look, and not only where it is retained, it was 32."""
    looks: list[float] = []

    def height(t: float) -> float:
        looks.append(t)
        return 0.0046 - 0.021 * t - 0.0003 * t**2

    root(height, 1.0)

    assert len(looks) <= 10


def test_the_secant_method_finds_where_a_function_equals_its_argument() -> None:
    """x = cos x, the Dottie number; iteration alone is off by 0.025 after six values."""
    method, x = SecantMethod(1.0), 1.0
    for _ in range(6):
        x = method.following(x, cos(x))

    assert x == pytest.approx(0.7390851332151607, abs=1e-14)


def test_the_secant_method_does_not_leave_its_bounds() -> None:
    """The line of x - f(x) through (1, 0.8) and (0.5, 0.4) is 0 at x = 0: f is tried instead."""
    method = SecantMethod(1.0, (1.0, 0.2))

    assert method.following(0.5, 0.1) == 0.1
