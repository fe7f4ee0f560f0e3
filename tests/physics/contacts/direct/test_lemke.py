"""Lemke's method: a solution where there is one, and none where numbers cannot be held."""

import numpy as np
import pytest

from sandbox.physics.contacts.direct.lemke import lemke


def test_a_solution_keeps_all_conditions() -> None:
    rng = np.random.default_rng(3)
    for count in (1, 2, 5, 12):
        root = rng.normal(size=(count, count))
        matrix, offset = root @ root.T + 0.1 * np.eye(count), rng.normal(size=count)
        z = lemke(matrix, offset)
        assert z is not None
        w = matrix @ z + offset
        assert min(z.min(), w.min()) >= -1e-9
        assert abs(float(w @ z)) <= 1e-9


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e308])
def test_numbers_that_cannot_be_held_have_none(value: float) -> None:
    """One of them in the table made all others none at its first pivot."""
    matrix = np.array([[1.0, value, 0.0], [value, 1.0, -1.0], [0.0, -1.0, 1.0]])
    with np.errstate(all="ignore"):
        found = lemke(matrix, np.array([-1.0, value, -2.0]))

    assert found is None or np.isfinite(found).all()
