"""NumPy's kernel gives the same bits as the function around it, and the same errors."""

import numpy as np
import pytest

from sandbox.physics.joints.exact.dense_systems import solve


@pytest.mark.parametrize("count", [2, 3, 6, 30, 150])
@pytest.mark.parametrize("sides", [None, 1, 2])
def test_bits_are_those_of_numpy(count: int, sides: int | None) -> None:
    draw = np.random.default_rng(count)
    matrix = draw.normal(size=(count, count))
    wanted = draw.normal(size=count if sides is None else (sides, count)).T

    assert np.array_equal(solve(matrix, wanted), np.linalg.solve(matrix, wanted))


def test_a_singular_matrix_is_refused() -> None:
    with pytest.raises(np.linalg.LinAlgError):
        solve(np.ones((3, 3)), np.arange(3.0))


def test_what_is_not_finite_has_no_finite_solution() -> None:
    assert np.isnan(solve(np.eye(2), np.array([np.nan, 1.0]))[0])
