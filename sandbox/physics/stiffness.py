"""How high a rate springs need: beyond it, leapfrog makes them explode."""

from collections.abc import Mapping

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.errors import SimulationError
from sandbox.physics.laws.spring import SpringForce

MARGIN = 4
"""How many times the least rate is advised: there the energy swings by 6 % at the most."""


def check_springs(
    springs: Mapping[str, SpringForce],
    agility: Array,
    angle: Array,
    rate: float,
    reach: float = 2.0,
) -> None:
    """Refuse springs that are too stiff, or damp too much, for a rate.

    Parameters
    ----------
    springs
        All of a scene, by name.
    agility
        (n, 3), one over mass, mass and moment [1/kg, 1/(kg m²)].
    angle
        (n,), of the bodies at the start [rad].
    rate
        Steps a second [Hz].
    reach
        The largest ω h at which the scheme is stable; 2 for leapfrog.

    Raises
    ------
    SimulationError
        If the scene is not stable at that rate; it names the spring that asks for most.
    """
    needed, name = limit(springs, agility, angle)
    needed *= 2 / reach
    if needed > rate * (1 + 1e-9):
        reason = (
            f"the spring '{name}' needs a 'rate' of at least {np.ceil(needed):,.0f}, not {rate:g}"
        )
        raise SimulationError(name, 0.0, reason, MARGIN * needed)


def limit(springs: Mapping[str, SpringForce], agility: Array, angle: Array) -> tuple[float, str]:
    """Return the rate at which springs are just stable [Hz], and the name of the stiffest.

    See `check_springs` for what they are given.
    """
    if not springs:
        return 0.0, ""
    reply = _replies(list(springs.values()), agility, angle)
    stiffness = np.repeat([spring.stiffness for spring in springs.values()], 2)
    damping = np.repeat([spring.damping for spring in springs.values()], 2)
    needed = _needed(*(_largest(reply, weight) for weight in (stiffness, damping)))
    own = reply.diagonal()
    alone = [_needed(k, c) for k, c in zip(stiffness * own, damping * own, strict=True)]
    return needed, list(springs)[int(np.argmax(alone)) // 2]


def _needed(stiffness: float, damping: float) -> float:
    """Return the rate at which a mode is just stable [Hz].

    At the limit velocities change sign each step. In that, x'' = −k x − c x' with the velocity
    guessed from the two before, 3/2 and −1/2, gives k h² / 4 + c h = 1: ω h = 2 without damping.
    """
    return float(damping + np.sqrt(damping**2 + stiffness)) / 2


def _largest(reply: Array, weight: Array) -> float:
    """Return the largest eigenvalue of M⁻¹ K, by that of √k J M⁻¹ Jᵀ √k."""
    root = np.sqrt(weight)
    return float(np.linalg.eigvalsh(root[:, None] * reply * root)[-1])


def _replies(springs: list[SpringForce], agility: Array, angle: Array) -> Array:
    """Return how the ends of springs part by unit forces along others: J M⁻¹ Jᵀ, (2 s, 2 s).

    Each counts in both directions of the plane, for it may come to point in any.
    """
    gradient = np.zeros((len(springs), 2, len(agility), 3))
    for row, spring in zip(gradient, springs, strict=True):
        for end, sign in zip(spring.ends, (-1.0, 1.0), strict=True):
            if end.body is not None:
                arm = end.point * np.exp(1j * angle[end.body])
                row[0, end.body] += sign * np.array([1.0, 0.0, -arm.imag])
                row[1, end.body] += sign * np.array([0.0, 1.0, arm.real])
    flat = gradient.reshape(2 * len(springs), -1)
    return np.asarray(flat * agility.ravel() @ flat.T)
