"""Forces that depend on the speed or on the time: the chapter, sections 4 and 7."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas.arrays import Array


def terminal_velocity(mass: float, drag: float, g: float) -> float:
    """Return the speed at which quadratic drag carries the weight [m/s]: √(m g / c)."""
    return float(np.sqrt(mass * g / drag))


def fall_velocity(t: ArrayLike, mass: float, drag: float, g: float) -> Array:
    """Return the velocity of a fall from rest with quadratic drag [m/s]; downwards negative.

    dv/dt = −g + (c/m) v² gives −vt tanh(g t / vt).
    """
    end = terminal_velocity(mass, drag, g)
    return np.asarray(-end * np.tanh(g * np.asarray(t, dtype=float) / end))


def throw_with_drag(
    t: ArrayLike, velocity: float, mass: float, drag: float, g: float = 0.0
) -> Array:
    """Return how far a throw with linear drag has come along one axis [m].

    dv/dt = −g − v/τ with τ = m/c gives (v0 + g τ) τ (1 − e^(−t/τ)) − g τ t.
    """
    t, tau = np.asarray(t, dtype=float), mass / drag
    return np.asarray((velocity + g * tau) * tau * -np.expm1(-t / tau) - g * tau * t)


def half_sine_momentum(t: ArrayLike, force: float, lasts: float) -> Array:
    """Return the momentum that F sin(π t / T) has given [kg m/s]: its integral, up to T."""
    phase = np.pi * np.minimum(np.asarray(t, dtype=float), lasts) / lasts
    return np.asarray(force * lasts / np.pi * (1 - np.cos(phase)))


def resultant(*forces: tuple[float, float]) -> tuple[float, float]:
    """Return the sum of forces [N]."""
    return sum(x for x, _ in forces), sum(y for _, y in forces)


def movable_pulley_acceleration(weight: float, wheel: float, g: float) -> float:
    """Return the upward acceleration of a movable pulley [m/s²].

    2 T − M g = M a and T − m g = −2 m a: (2 m − M) g / (4 m + M).
    """
    return (2 * weight - wheel) * g / (4 * weight + wheel)
