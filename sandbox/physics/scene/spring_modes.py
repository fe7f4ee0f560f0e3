"""The modes of springs: how fast the stiffest combination of them swings."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.forces.spring import SpringForce

LARGE = 400
"""Rows, above which one eigenvalue is sought and not all: thousands take seconds and gigabytes."""

NEARLY = 1e-4
"""The relative residual of what is sought: in a chain of 1,500 equal springs, whose eigenvalues lie
close to each other, the largest one is 7e-6 too low."""

TRIED = 40
"""Vectors that Lanczos's method keeps."""


class SpringModes:
    """The relative accelerations of the ends of s springs by unit forces, J M⁻¹ Jᵀ.

    Each spring has two rows, for both axes of the plane, as its direction can change. For
    parameters see `check_springs`; b bodies have springs.

    Attributes
    ----------
    own
        (2 s,), those by the force of the same row.
    """

    def __init__(self, springs: Sequence[SpringForce], inverse_mass: Array, angle: Array) -> None:
        ends = [end for spring in springs for end in spring.ends]
        held = len(inverse_mass)  # an end on the plane is on a body that cannot move
        bodies = np.array([held if end.body is None else end.body for end in ends], dtype=np.intp)
        turned = np.exp(1j * np.append(angle, 0.0))[bodies]
        arms = np.array([end.point for end in ends]) * turned
        touched, local = np.unique(bodies, return_inverse=True)
        self._body = local.reshape(-1, 2)
        self._inverse = np.append(inverse_mass, np.zeros((1, 3)), axis=0)[touched]
        self._jacobian = _rows(arms.reshape(-1, 2))
        one = self._body[:, 0] == self._body[:, 1]  # both ends on one body
        self._jacobian[one, 0] += self._jacobian[one, 1]
        self._jacobian[one, 1] = 0.0
        weighed = self._jacobian * self._inverse[self._body][:, :, None]
        self.own = np.einsum("seai,seai->sa", weighed, self._jacobian).ravel()

    def largest(self, weight: Array) -> float:
        """Return the largest eigenvalue of √k J M⁻¹ Jᵀ √k, with weights k, (2 s,)."""
        root = np.sqrt(weight)

        def matrix() -> Array:
            return np.asarray(root[:, None] * self._delassus() * root)

        def times(force: Array) -> Array:
            return root * self._accelerations(root * force)

        return largest_eigenvalue(len(root), matrix, times)

    def _accelerations(self, force: Array) -> Array:
        """Return J M⁻¹ Jᵀ times forces along the rows: (2 s,)."""
        given = np.zeros_like(self._inverse)
        np.add.at(
            given, self._body, np.einsum("seai,sa->sei", self._jacobian, force.reshape(-1, 2))
        )
        moved = (given * self._inverse)[self._body]
        return np.einsum("seai,sei->sa", self._jacobian, moved).ravel()

    def _delassus(self) -> Array:
        """Return J M⁻¹ Jᵀ: (2 s, 2 s)."""
        count, axes = len(self._body), np.arange(2)
        spread = np.zeros((count, 2, *self._inverse.shape))  # (s, 2, b, 3)
        for end in (0, 1):
            rows = np.arange(count)[:, None]
            spread[rows, axes, self._body[:, end, None]] += self._jacobian[:, end]
        flat = spread.reshape(2 * count, -1)
        return np.asarray(flat * self._inverse.ravel() @ flat.T)


def _rows(arms: Array) -> Array:
    """Return the rows of springs from the arms of their ends, (s, 2), x + iy: (s, 2, 2, 3)."""
    rows = np.zeros((*arms.shape, 2, 3))
    rows[..., 0, 0] = rows[..., 1, 1] = 1.0
    rows[..., 0, 2], rows[..., 1, 2] = -arms.imag, arms.real
    return rows * np.array([-1.0, 1.0])[:, None, None]


def largest_eigenvalue(
    rows: int, matrix: Callable[[], Array], times: Callable[[Array], Array]
) -> float:
    """Return the largest eigenvalue of a positive semidefinite matrix, (rows, rows).

    `matrix` makes it, and `times` returns its product with a vector, (rows,). Infinite if values
    are not finite.
    """
    if rows <= LARGE:
        made = matrix()
        return float(np.linalg.eigvalsh(made)[-1]) if np.isfinite(made).all() else np.inf
    first = times(np.sin(1.0 + np.arange(rows)))  # not by chance: the same bits every time
    if not np.isfinite(first).all():
        return np.inf
    return _sought(rows, times, first) if first.any() else 0.0


def _sought(rows: int, times: Callable[[Array], Array], first: Array) -> float:
    """Return the largest eigenvalue by Lanczos's method from a first vector."""
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

    scale = float(np.abs(first).max())  # ARPACK squares what it is given
    operator: Any = LinearOperator((rows, rows), matvec=lambda v: times(v.ravel()), dtype=float)
    try:
        (found,) = eigsh(
            operator, 1, None, None, "LA", first / scale, TRIED, None, NEARLY,
            return_eigenvectors=False,
        )  # fmt: skip
    except ArpackNoConvergence as close:
        found = max(close.eigenvalues, default=np.inf)
    return float(found)
