"""A row always gets the same draws, whichever rows are made with it."""

from typing import get_args

import numpy as np
import pytest

from sandbox.experiments.random_points import Method, points


@pytest.mark.parametrize("method", get_args(Method))
def test_a_row_is_the_same_in_whatever_company(method: Method) -> None:
    whole = points(method, 3, 2, 4096, 0, 4096)
    assert whole.shape == (4096, 2)
    assert ((whole > 0) & (whole < 1)).all()
    for start, stop in ((0, 1), (1000, 1030), (1023, 2049), (4095, 4096)):
        assert (points(method, 3, 2, 4096, start, stop) == whole[start:stop]).all()


@pytest.mark.parametrize("method", get_args(Method))
def test_another_seed_draws_otherwise(method: Method) -> None:
    assert (points(method, 1, 2, 64, 0, 64) != points(method, 2, 2, 64, 0, 64)).any()


def test_a_hypercube_has_one_point_in_each_part() -> None:
    parts = np.floor(points("latin-hypercube", 0, 3, 100, 0, 100) * 100)
    for column in parts.T:
        assert sorted(column) == list(range(100))


def test_sobol_s_points_integrate_better_than_random_ones() -> None:
    def off(method: Method) -> float:
        x = points(method, 5, 2, 4096, 0, 4096)
        return abs(float((x[:, 0] * x[:, 1]).mean()) - 0.25)

    assert off("sobol") < off("random") / 10
