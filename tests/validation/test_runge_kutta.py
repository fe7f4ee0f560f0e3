"""The reference solver agrees with closed forms, at any requested times."""

import numpy as np
import pytest

from validation.formulas import runge_kutta
from validation.formulas.runge_kutta import solution

START = np.array([1.0, 0.0])


def swing(y: np.ndarray) -> np.ndarray:
    return np.array([y[1], -y[0]])


def test_an_oscillator_swings_as_a_cosine() -> None:
    t = np.array([7.0, 0.0, 0.5, 0.5])
    found = solution(swing, START, t)

    assert found == pytest.approx(np.stack([np.cos(t), -np.sin(t)]), abs=1e-12)
    assert solution(swing, START, 0.5) == pytest.approx(found[:, 2], abs=1e-12)
    assert (solution(swing, START, 0.0) == START).all()


def test_its_error_is_what_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    errors = []
    for tolerance in (1e-6, 1e-9):
        monkeypatch.setattr(runge_kutta, "RELATIVE", tolerance)
        monkeypatch.setattr(runge_kutta, "ABSOLUTE", tolerance)
        errors.append(abs(solution(swing, START, 10.0)[0] - np.cos(10.0)))

    assert 1e-8 < errors[0] < 1e-5
    assert 1e-12 < errors[1] < 1e-8


def test_what_runs_away_before_the_time_asked_for_is_an_error() -> None:
    """y' = y² from 1 is 1 / (1 − t)."""
    with pytest.raises(ArithmeticError):
        solution(np.square, np.ones(1), 2.0)
