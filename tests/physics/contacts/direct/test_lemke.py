"""Lemke's method: a solution where there is one, and none where numbers cannot be held."""

import numpy as np

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


def test_numbers_that_cannot_be_held_have_none() -> None:
    """An overflow at a pivot left no row to choose from."""
    matrix = np.array([[-0.5, 5e99, -8e299], [-0.5, -1e299, 1.4e300], [-0.2, 5e299, -2e299]])
    with np.errstate(all="ignore"):
        found = lemke(matrix, np.array([1.0, 0.07, -1.1e307]))

    assert found is None or np.isfinite(found).all()
