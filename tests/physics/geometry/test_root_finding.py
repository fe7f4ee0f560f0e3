"""The root of a function of one number."""

from math import cos, inf

import pytest

from sandbox.physics.geometry.root_finding import root


def test_it_is_where_the_function_falls_to_nothing() -> None:
    assert root(cos, 3.0) == pytest.approx(1.5707963267948966, abs=1e-13)
    assert root(lambda x: 1 - x**9, 4.0) == pytest.approx(1.0, abs=1e-13)


def test_what_stays_above_has_none_and_what_begins_below_is_there() -> None:
    assert root(lambda x: 1 + x, 1.0) == inf
    assert root(lambda x: -1 - x, 1.0) == 0.0
