"""Shortest vectors within limits, and the sizes of numbers."""

from math import inf, isnan, nan

import numpy as np
import pytest

from sandbox.physics.contacts.direct.linear_systems import least_distance, most


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
    assert most(np.array(values)) == largest


def test_no_size_is_known_of_what_is_not_a_number() -> None:
    """Or the solution of rows that repeat each other would be taken for a small one."""
    assert isnan(most(np.array([nan, 1.0])))
    assert isnan(most(np.array([1.0, nan, inf])))
