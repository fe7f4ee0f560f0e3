"""Which contacts push: random problems, and those that guesses alone do not solve."""

from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import (
    NO_FRICTION,
    Active,
    Friction,
    Problem,
)
from sandbox.physics.contacts.direct.complementarity.lemke import lemke
from sandbox.physics.contacts.direct.complementarity.mixed_complementarity import (
    Unsolvable,
    solve,
    solve_one,
)

SEEDS = st.integers(0, 10_000)


def contacts(count: int, bodies: int, draw: np.random.Generator) -> tuple[Array, Array]:
    """Return the matrix and rates of contacts between bodies of masses that differ by 1000."""
    jacobian = draw.normal(size=(2 * count, 3 * bodies))
    inverse = 10 ** draw.uniform(-3, 0, size=3 * bodies)
    return jacobian * inverse @ jacobian.T, jacobian @ draw.normal(size=3 * bodies)


@given(seed=SEEDS, count=st.integers(1, 12), bodies=st.integers(1, 6))
def test_lemkes_method_solves_what_pushes(seed: int, count: int, bodies: int) -> None:
    """With more contacts than bodies can move many rows repeat each other."""
    matrix, rate = contacts(count, bodies, np.random.default_rng(seed))
    found = lemke(matrix + 1e-9 * np.eye(2 * count), rate)

    assert found is not None
    left = matrix @ found + rate
    size = 1e-6 * (1 + np.abs(rate).max() + found.max())
    assert found.min() >= 0
    assert left.min() >= -size
    assert np.abs(found * left).max() <= size * (1 + found.max())


@pytest.mark.sweep
@given(seed=SEEDS, count=st.integers(1, 5), bodies=st.integers(4, 8), mu=st.floats(0, 1.5))
def test_every_contact_pushes_sticks_or_slips(
    seed: int, count: int, bodies: int, mu: float
) -> None:
    """0 <= x, r >= 0, x r = 0; |x_t| <= mu x_n, and against the slip where it is as large."""
    draw = np.random.default_rng(seed)
    matrix, rate = contacts(count, bodies, draw)
    normals, slips = np.arange(count), count + np.arange(count)
    pushes = np.arange(2 * count) < count
    both = np.full(count, mu)
    friction = Friction(slips, np.stack((normals, np.full(count, -1))), both, both)
    problem = Problem(np.zeros(2 * count, dtype=bool), pushes, friction)
    guess = Active(np.append(rate[:count] < 0, np.zeros(count, dtype=bool)), np.zeros(count, int))
    impulse, _ = solve(problem, matrix, rate, guess)

    left = matrix @ impulse + rate
    size = np.sqrt(matrix.diagonal())
    close = 1e-6 * (np.abs(rate / size).max() + np.abs(impulse * size).max())
    assert (impulse[:count] * size[:count] >= -close).all()
    assert (left[:count] / size[:count] >= -close).all()
    bound = mu * np.maximum(impulse[:count], 0)
    assert ((np.abs(impulse[count:]) - bound) * size[count:] <= close).all()
    sticks = (bound - np.abs(impulse[count:])) * size[count:] > 10 * close
    assert (np.abs(left[count:] / size[count:])[sticks] <= close).all()
    assert (impulse[count:] * left[count:] <= close * (1 + np.abs(impulse[count:]))).all()


def test_rows_that_repeat_each_other_share_the_least_impulses() -> None:
    """Two feet under one load: half each."""
    problem = Problem(np.zeros(2, dtype=bool), np.ones(2, dtype=bool), NO_FRICTION)
    guess = Active(np.ones(2, dtype=bool), np.zeros(0, dtype=np.intp))
    impulse, active = solve(problem, np.ones((2, 2)), np.array([-1.0, -1.0]), guess)

    assert impulse == pytest.approx([0.5, 0.5], abs=1e-12)
    assert active.on.all()


def test_friction_is_shared_as_far_as_each_contact_holds() -> None:
    """A smooth foot and a rough one: half the push is too much for the first.

    Both feet stick with x = (n, W - n, t, W/2 - t) for t <= n / 10; the least of these has t there:
    the square's derivative 2 n - 2 (W - n) + 2 t / 10 - 2 (W/2 - t) / 10 is 0 at n = W 1.05 / 2.02.
    """
    free, pushes = np.zeros(4, dtype=bool), np.array([True, True, False, False])
    sticks = np.array([0.1, 1.5])
    friction = Friction(np.array([2, 3]), np.array([[0, 1], [-1, -1]]), sticks, sticks)
    guess = Active(np.ones(4, dtype=bool), np.zeros(2, dtype=np.intp))
    same = np.arange(4) // 2
    matrix = np.equal.outer(same, same).astype(float)
    rate = np.array([-1.0, -1.0, -0.5, -0.5])
    impulse, active = solve(Problem(free, pushes, friction), matrix, rate, guess)

    n = 1.05 / 2.02
    assert impulse == pytest.approx([n, 1 - n, n / 10, 0.5 - n / 10], abs=1e-12)
    assert active.on.all()


@pytest.mark.parametrize(("own", "rate"), [(2.5, -0.7), (1e-6, 3.0), (4e7, 1e-3)])
def test_a_single_joint_takes_the_same_impulse_alone(own: float, rate: float) -> None:
    """To the last bit: what is solved in plain numbers is what all rows are solved for."""
    problem = Problem(np.array([True]), np.array([False]), NO_FRICTION)
    guess = Active(np.array([True]), np.zeros(0, dtype=np.intp))
    impulse, _ = solve(problem, np.array([[own]]), np.array([rate]), guess)

    assert solve_one(own, rate, 0.0, inf) == impulse[0]


def test_a_single_joint_that_moves_nothing_is_told() -> None:
    with pytest.raises(Unsolvable):
        solve_one(0.0, 1.0, 0.0, inf)


def test_what_contradicts_itself_is_told() -> None:
    """A contact that must part, of two bodies that a joint keeps together."""
    problem = Problem(np.array([True, False]), np.array([False, True]), NO_FRICTION)
    guess = Active(np.array([True, True]), np.zeros(0, dtype=np.intp))
    with pytest.raises(Unsolvable):
        solve(problem, np.ones((2, 2)), np.array([0.0, -1.0]), guess)


def test_what_is_slack_excuses_no_contradiction() -> None:
    """Two joints that ask for rates 1e-5 m/s apart, beside a rope that is slack by 48 m/s."""
    problem = Problem(np.array([True, True, False]), np.array([False, False, True]), NO_FRICTION)
    matrix = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    guess = Active(np.array([True, True, False]), np.zeros(0, dtype=np.intp))
    with pytest.raises(Unsolvable):
        solve(problem, matrix, np.array([1e-5, 0.0, 48.0]), guess)


@pytest.mark.parametrize(("alike", "same"), [((0, 0, 2, 2), True), ((0, 1, 2, 3), False)])
def test_the_least_impulses_do_not_depend_on_the_axes(
    alike: tuple[int, ...], *, same: bool
) -> None:
    """Two pins side by side carry a beam; each keeps two axes, which are turned by 0.7 rad."""
    turn = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    turned = np.kron(np.eye(2), turn)
    pins = np.array([[1, 0, 0], [0, 1, -1], [1, 0, 0.5], [0, 1, 2]], dtype=float)
    rates = pins @ (0.3, -1.0, 0.2)
    rows = np.ones(4, dtype=bool)
    problem = Problem(rows, ~rows, NO_FRICTION, np.array(alike))
    guess = Active(rows, np.zeros(0, dtype=np.intp))

    one, _ = solve(problem, pins @ pins.T, rates, guess)
    matrix = turned @ pins @ pins.T @ turned.T
    other, _ = solve(problem, matrix, turned @ rates, guess)

    assert (np.abs(turned @ one - other).max() < 1e-12) == same  # 3e-16, and 0.02


@given(seed=SEEDS, count=st.integers(4, 12))
def test_a_row_that_asks_for_nothing_gives_nothing(seed: int, count: int) -> None:
    """Neither a slack rope nor what is yet to strike is a way out, however long one is sought."""
    matrix, rate = contacts(count, 2, np.random.default_rng(seed))
    rows = np.arange(2 * count)
    problem = Problem(np.zeros_like(rows, dtype=bool), rows % 3 > 0, NO_FRICTION)
    guess = Active(problem.pushes & (rate < 0), np.zeros(0, dtype=int))

    impulse, _ = solve(problem, matrix, rate, guess)

    assert not impulse[~problem.pushes].any()
