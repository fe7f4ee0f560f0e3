"""The reference solver: of fourth order, and right where a closed form is known."""

import numpy as np
import pytest

from validation.formulas import runge_kutta
from validation.formulas.runge_kutta import solution


def swing(y: np.ndarray) -> np.ndarray:
    return np.array([y[1], -y[0]])


def test_an_oscillator_swings_as_a_cosine() -> None:
    t = np.array([0.0, 0.5, 7.0])
    found = solution(swing, np.array([1.0, 0.0]), t)

    assert found == pytest.approx(np.stack([np.cos(t), -np.sin(t)]), abs=1e-12)
    assert solution(swing, np.array([1.0, 0.0]), 0.5) == pytest.approx(found[:, 1], abs=1e-12)


def test_its_error_is_of_fourth_order(monkeypatch: pytest.MonkeyPatch) -> None:
    errors = []
    for step in (0.1, 0.05):
        monkeypatch.setattr(runge_kutta, "STEP", step)
        errors.append(abs(solution(swing, np.array([1.0, 0.0]), 10.0)[0] - np.cos(10.0)))

    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.2)
