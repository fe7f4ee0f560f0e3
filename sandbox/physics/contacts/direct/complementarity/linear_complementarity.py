"""Contacts with friction as a linear complementarity problem, for Lemke's method.

Joints always hold, and are eliminated. Friction is the difference of two non-negative impulses in
opposite directions, whose sum a last condition bounds (Stewart and Trinkle 1996).
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Problem
from sandbox.physics.contacts.direct.complementarity.lemke import lemke

FAINT = 1e-12
"""The share of a row's own inverse mass that is rounding."""


def by_lemke(
    problem: Problem, delassus: Array, rate: Array, bounds: Array, soft: float
) -> Array | None:
    """Return impulses, (m,), that satisfy the rows approximately; None if none are found.

    `delassus`, (m, m), and `rate`, (m,), are as of `mixed_complementarity.solve`, with each row's
    own inverse mass near one. `bounds`, (f, m), is the size of sliding friction as a matrix of the
    impulses; `soft` is the compliance that is added to each row's own inverse mass.
    """
    free, pushes, row = (
        np.flatnonzero(problem.free),
        np.flatnonzero(problem.pushes),
        problem.friction.row,
    )
    through: Array = np.zeros((len(free), len(rate) + 1))
    matrix, freely = delassus, rate
    if len(free):
        within = matrix[np.ix_(free, free)] + FAINT * np.eye(len(free))
        rhs = np.column_stack((matrix[free], rate[free]))
        through = np.asarray(np.linalg.solve(within, rhs), dtype=float)
        across: Array = np.asarray(matrix[:, free] @ through)
        matrix, freely = matrix - across[:, :-1], rate - across[:, -1]
    rows = np.concatenate((pushes, row))
    both, one = matrix[np.ix_(rows, rows)] + soft * np.eye(len(rows)), freely[rows]
    found = _pushes(both, one, bounds[:, pushes])
    if found is None:
        return None
    impulse = np.zeros_like(rate)
    impulse[rows] = found
    impulse[free] = -(through[:, :-1] @ impulse + through[:, -1])
    return impulse


def _pushes(matrix: Array, rate: Array, bounds: Array) -> Array | None:
    """Return the impulses of c contacts and f rows of friction without joints: (c + f,).

    The arguments are as above: (c + f, c + f), (c + f,) and (f, c).
    """
    rubs, count = bounds.shape
    directions = np.column_stack((np.eye(count + rubs), -np.eye(count + rubs)[:, count:]))
    whole = np.zeros((count + 3 * rubs, count + 3 * rubs))
    signed, twice = count + 2 * rubs, np.concatenate((np.eye(rubs), np.eye(rubs)))
    whole[:signed, :signed] = directions.T @ matrix @ directions
    whole[count:signed, signed:] = twice
    whole[signed:, :count] = bounds
    whole[signed:, count:signed] = -twice.T
    found = lemke(whole, np.concatenate((directions.T @ rate, np.zeros(rubs))))
    return None if found is None else directions @ found[:signed]
