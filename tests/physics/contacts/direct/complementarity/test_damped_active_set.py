"""Damped updates of an active set: most problems that go in circles are solved by them."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity import mixed_complementarity
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import (
    Active,
    Friction,
    Problem,
)
from sandbox.physics.contacts.direct.complementarity.linear_complementarity import by_lemke

PAIRS, BODIES, MU = 40, 30, 0.5


def thrown(seed: int) -> tuple[Problem, Array, Array, Active]:
    """Return 40 rubbing contacts of 30 unit bodies that move at random; none is guessed to bear."""
    draw = np.random.default_rng(seed)
    jacobian = np.zeros((2 * PAIRS, 3 * BODIES))
    for contact in range(PAIRS):
        way = np.exp(1j * draw.uniform(0, 2 * np.pi))
        a, b = draw.choice(BODIES, 2, replace=False)
        for body, sign in ((a, -1), (b, 1)):
            at = slice(3 * body, 3 * body + 3)
            jacobian[contact, at] = sign * way.real, sign * way.imag, 0
            jacobian[PAIRS + contact, at] = -sign * way.imag, sign * way.real, 1
    pushes = np.arange(2 * PAIRS) < PAIRS
    normals, slips = np.arange(PAIRS), PAIRS + np.arange(PAIRS)
    both = np.full(PAIRS, MU)
    friction = Friction(slips, np.stack((normals, np.full(PAIRS, -1))), both, both)
    problem = Problem(np.zeros(2 * PAIRS, dtype=bool), pushes, friction)
    rate = jacobian @ draw.normal(size=3 * BODIES)
    guess = Active(np.zeros(2 * PAIRS, dtype=bool), np.zeros(PAIRS, dtype=np.intp))
    return problem, jacobian @ jacobian.T, rate, guess


def test_most_of_a_crowd_is_solved_without_lemkes_method(monkeypatch: pytest.MonkeyPatch) -> None:
    """3 of these 30 problems need it; without damped updates all of them do."""
    needed = []

    def counted(*args: object) -> Array | None:
        needed.append(args)
        return by_lemke(*args)  # type: ignore[arg-type]

    monkeypatch.setattr(mixed_complementarity, "by_lemke", counted)
    for seed in range(30):
        problem, matrix, rate, guess = thrown(seed)
        impulse, active = mixed_complementarity.solve(problem, matrix, rate, guess)
        left, normal = matrix @ impulse + rate, impulse[:PAIRS]
        assert normal.min() >= -1e-9
        assert left[:PAIRS].min() >= -1e-9
        assert np.abs(normal * left[:PAIRS]).max() <= 1e-9
        assert (np.abs(impulse[PAIRS:]) <= MU * normal + 1e-9).all()
        assert np.abs(left[active.on]).max(initial=0.0) <= 1e-9
    assert len(needed) <= 5
