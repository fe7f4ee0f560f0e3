"""Whether the equations of joints can be solved together, and what helps if not."""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array

SMOOTH = 0.5
"""ω dt of the fastest swing under tension at the rate that is advised."""

NUDGE = 1e-6
"""m, rad, by which coordinates are changed to see how the forces of joints change."""


def solved(delassus: Array, violation: Array) -> Array:
    """Solve a linear system; one equation in a tenth of the time."""
    if len(violation) == 1:
        return violation / delassus[0]
    return np.linalg.solve(delassus, violation).astype(float, copy=False)


def independence(delassus: Array) -> tuple[float, Array]:
    """Return the smallest singular value over the largest, and each row's share in it.

    Every row counts as if it alone moved its bodies by one.
    """
    scale = np.sqrt(delassus.diagonal())
    _, sizes, directions = np.linalg.svd(delassus / np.outer(scale, scale))
    return float(sizes[-1] / sizes[0]), np.abs(directions[-1])


def steps_needed(force: Callable[[Array], Array], inverse: Array, drift: float) -> float:
    """Return how many times as many steps joints under tension need, at least 2.

    Under tension joints are springs across: K = Σ λ ∂²C/∂q², of which the fastest swing is that
    of the largest eigenvalue of M⁻¹ K; of a pendulum ω² = T / (m l).

    Parameters
    ----------
    force
        Returns λᵀ J where the coordinates are changed by so much: (3 N,) of (3 N,).
    inverse
        (3 N,), one over the mass or moment of each coordinate.
    drift
        How long a drift lasts [s].
    """
    root = np.sqrt(inverse)
    stiffness = np.zeros((len(root), len(root)))
    for at in np.flatnonzero(root):
        step = np.zeros_like(root)
        step[at] = NUDGE
        stiffness[at] = (force(step) - force(-step)) / (2 * NUDGE)
    swing = root[:, None] * (stiffness + stiffness.T) / 2 * root
    if not np.isfinite(swing).all():
        return 2.0
    omega = float(np.sqrt(np.abs(np.linalg.eigvalsh(swing)).max()))
    return max(omega * abs(drift) / SMOOTH, 2.0)
