"""Shortest vectors within limits, least solutions, and the sizes of numbers."""

from math import inf, isnan, nan

import numpy as np
import pytest

from sandbox.physics.contacts.direct.complementarity.redundant_systems import (
    least_distance,
    max_abs,
    nearest,
)


def test_the_shortest_vector_is_on_the_limit_that_is_farthest() -> None:
    limits, least = np.array([[1.0, 0.0], [0.0, 2.0]]), np.array([-1.0, 6.0])

    assert least_distance(limits, least) == pytest.approx([0.0, 3.0])


def test_limits_that_contradict_each_other_leave_none() -> None:
    assert least_distance(np.array([[1.0], [-1.0]]), np.array([1.0, 1.0])) is None


@pytest.mark.parametrize("ways", [1, 3])
def test_without_limits_the_shortest_vector_is_none_at_all(ways: int) -> None:
    """SciPy's method ended the interpreter here: a trebuchet with an arm of 2e10 kg."""
    found = least_distance(np.empty((0, ways)), np.empty(0))

    assert found is not None
    assert found.tolist() == [0.0] * ways


@pytest.mark.parametrize(
    ("values", "largest"), [([], 0.0), ([-3.0, 2.0], 3.0), ([-0.0], 0.0), ([1.0, -inf], inf)]
)
def test_the_size_of_the_largest_number_counts_whatever_its_sign(
    values: list[float], largest: float
) -> None:
    assert max_abs(np.array(values)) == largest


def test_no_size_is_known_of_what_is_not_a_number() -> None:
    """Or the solution of rows that repeat each other would be taken for a small one."""
    assert isnan(max_abs(np.array([nan, 1.0])))
    assert isnan(max_abs(np.array([1.0, nan, inf])))


@pytest.mark.parametrize("repeated", [0, 2])
@pytest.mark.parametrize("count", [1, 2, 12])
def test_the_nearest_solution_is_the_least_of_all_that_meet_a_system_as_well(
    count: int, repeated: int
) -> None:
    """As singular values tell it, whether rows repeat each other or not."""
    rows = np.cos(np.arange(count * 15.0)).reshape(count, 15)
    rows = np.concatenate((rows, rows[:repeated]))
    matrix = rows @ rows.T
    wanted = np.sin(np.arange(3.0 * len(rows))).reshape(len(rows), 3)

    expected = np.linalg.lstsq(matrix, wanted, rcond=1e-10)[0]

    assert nearest(matrix, wanted) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert nearest(matrix, wanted[:, 0]) == pytest.approx(expected[:, 0], rel=1e-9, abs=1e-9)


def test_what_cannot_be_changed_is_left_alone() -> None:
    assert nearest(np.zeros((1, 1)), np.ones(1)).tolist() == [0.0]
