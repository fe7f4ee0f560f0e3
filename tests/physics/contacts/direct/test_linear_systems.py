"""Shortest vectors within limits."""

import numpy as np
import pytest

from sandbox.physics.contacts.direct.linear_systems import least_distance


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
