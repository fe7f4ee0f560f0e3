"""Solvability of the equations of joints, and the number of steps that they need."""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.dense_systems import solve

SMOOTH = 0.5
"""At the step rate that is advised, ω dt of the fastest oscillation under tension."""

NUDGE = 1e-6
"""m, rad, the step of the finite differences of the joints' forces."""


def solved(delassus: Array, violation: Array) -> Array:
    """Solve a linear system; a single equation takes a tenth of the time."""
    if len(violation) == 1:
        return violation / delassus[0]
    return solve(delassus, violation)


def independence(delassus: Array) -> tuple[float, Array]:
    """Return the ratio of smallest to largest singular value, and each row's share in the former.

    The matrix is scaled to a diagonal of ones.
    """
    scale = np.sqrt(delassus.diagonal())
    _, sizes, directions = np.linalg.svd(delassus / np.outer(scale, scale))
    return float(sizes[-1] / sizes[0]), np.abs(directions[-1])


def steps_needed(force: Callable[[Array], Array], inverse: Array, drift: float) -> float:
    """Return the factor, at least 2, by which joints under tension need more steps.

    Joints under tension are transverse springs: K = Σ λ ∂²C/∂q². The largest eigenvalue of M⁻¹ K is
    ω² of the fastest oscillation; for a pendulum ω² = T / (m l). `force` returns λᵀ J, (3 N,),
    after a displacement of the coordinates, (3 N,); `inverse` is the inverse mass or moment of
    inertia of each, (3 N,), and `drift` the duration of a drift [s].
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
