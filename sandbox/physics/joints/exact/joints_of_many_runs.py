"""The exact joints of many runs, solved at once: `ExactJoints` with a leading axis of runs.

Every run goes through the same operations as alone, in the same order, and ends its iterations
at the same point. So all results are equal to the last bit to those of single runs.
"""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.joints.exact.constraint_interface import (
    GROWS,
    MAX_ITERATIONS,
    QUADRATIC,
    Coordinates,
    coordinate_indices,
    inertia_of,
    kinetic_energy,
    translations,
)
from sandbox.physics.joints.exact.shake import ExactJoints, parabola

DOUBTED = 1 + (GROWS - 1) / 2
"""The largest growth factor of the kinetic energy in a kick; beyond it the run is solved alone."""


class ManyJoints:
    """The joints of N runs; n bodies and m equations in each.

    The joints of each run are all `plain`, and right after its start; `step` is the duration of
    each kick and each drift [s].
    """

    def __init__(self, joints: Sequence[ExactJoints], step: float) -> None:
        first = joints[0]
        self._order, self._step = coordinate_indices(len(first.inverse) // 3 - 1), step
        self._reaches = first.reaches.with_points(np.array([one.reaches.points for one in joints]))
        self._inverse = np.array([one.inverse for one in joints])
        self._inertia = inertia_of(self._inverse)
        self._length = np.array([one.lengths(0.0) for one in joints])
        self._origin = np.array([[one.origin] for one in joints])
        depth = min(len(one.past) for one in joints)
        self._past = [np.array([one.past[i] for one in joints]) for i in range(depth)]

    def keep(self, rows: Booleans) -> None:
        """Keep only some of the runs: (N,)."""
        self._reaches = self._reaches.with_points(self._reaches.points[rows])
        for name in ("_inverse", "_inertia", "_length", "_origin"):
            setattr(self, name, getattr(self, name)[rows])
        self._past = [tension[rows] for tension in self._past]

    def solve(self, pose: Array, velocity: Array) -> tuple[Array, Booleans]:
        """Return the velocities with which the joints hold through the next drift: (N, n, 3).

        Also return which runs must be solved alone, (N,). Positions and velocities, (N, n, 3), are
        those at the kick [m, rad, m/s, rad/s].
        """
        here = Coordinates(self._values(pose))
        translations(here.values)[:, :-1] -= self._origin
        motion = self._values(velocity)
        response = self._reaches.evaluate(here).jacobian * self._inverse[:, None]
        impulse, lost = self._newton(here.values, motion, response)
        moved = motion - _times(impulse, response)
        rounding = self._inertia.sum(axis=1) * (QUADRATIC / self._step) ** 2 / 2
        left, had = (kinetic_energy(self._inertia, rates) for rates in (moved, motion))
        gained = left > DOUBTED * had + rounding
        self._past = [impulse / self._step, *self._past[:2]]
        return moved[:, self._order], lost | gained

    def _newton(self, pose: Array, motion: Array, response: Array) -> tuple[Array, Booleans]:
        """Return the impulses, (N, m), and which runs did not converge."""
        impulse, h = parabola(self._past) * self._step, self._step
        seeking = np.ones(len(pose), dtype=bool)
        across = response.swapaxes(1, 2)
        for _ in range(MAX_ITERATIONS):
            moved = motion - _times(impulse, response)
            there = self._reaches.evaluate(Coordinates(pose + h * moved))
            violation = there.total - self._length
            better = impulse + _solved(there.jacobian @ across, violation) / h
            impulse = better if seeking.all() else np.where(seeking[:, None], better, impulse)
            seeking &= ~(_times(violation, violation[:, :, None])[:, 0] <= QUADRATIC**2)
            if not seeking.any():
                break
        return impulse, seeking

    def _values(self, rows: Array) -> Array:
        """Return positions or velocities in the order of `Coordinates`: (N, 3 (n + 1))."""
        values = np.zeros((len(rows), self._inverse.shape[1]))
        values[:, self._order] = rows
        return values


def _times(vectors: Array, matrices: Array) -> Array:
    """Multiply each vector, (N, m), by its own matrix, (N, m, k)."""
    return np.asarray((vectors[:, None] @ matrices)[:, 0])


def _solved(delassus: Array, violation: Array) -> Array:
    """Solve the linear system of each run: (N, m)."""
    if violation.shape[1] == 1:
        return violation / delassus[:, 0]
    return np.asarray(np.linalg.solve(delassus, violation[:, :, None])[:, :, 0], dtype=float)
