"""Pendulums and oscillators: the chapter, sections 5, 8 and 9."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas.arrays import Array


def agm(a: float, b: float) -> float:
    """Return the arithmetic-geometric mean, to which Gauss's two means draw together."""
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, float(np.sqrt(a * b))
    return a


def pendulum_period(length: float, g: float, amplitude: float) -> float:
    """Return the period of a simple pendulum of any amplitude below π [s].

    4 √(L/g) K(sin(θ/2)), with K(k) = π / (2 agm(1, √(1 − k²))): the complete elliptic integral that
    the Lagrange equation of the chapter's section 9, θ'' = −(g/L) sin θ, leads to.
    """
    return float(2 * np.pi * np.sqrt(length / g) / agm(1.0, float(np.cos(amplitude / 2))))


def physical_pendulum_period(length: float, g: float, amplitude: float) -> float:
    """Return the period of a thin stick on a pin at its end [s].

    I = m L² / 3 about the pin: as a simple pendulum of I / (m L / 2) = 2 L / 3.
    """
    return pendulum_period(2 * length / 3, g, amplitude)


def pendulum_energy(mass: float, g: float, *heights: float) -> float:
    """Return the energy of equal masses at rest at some heights [J]: Σ m g h."""
    return mass * g * sum(heights)


def oscillator_period(mass: float, stiffness: float) -> float:
    """Return the period of a spring [s], whatever its amplitude: 2 π √(m / k)."""
    return float(2 * np.pi * np.sqrt(mass / stiffness))


def oscillator_amplitude(mass: float, stiffness: float, speed: float) -> float:
    """Return how far a spring is drawn by a body that passes its middle at a speed [m].

    m v² / 2 = k A² / 2, the chapter's section 5.
    """
    return float(speed * np.sqrt(mass / stiffness))


def damped_oscillation(
    t: ArrayLike, mass: float, stiffness: float, damping: float, amplitude: float
) -> Array:
    """Return how far a damped spring is drawn out, from rest at its amplitude [m].

    m x'' + c x' + k x = 0; its two exponents are the roots of m s² + c s + k, real or complex.
    """
    t = np.asarray(t, dtype=float)
    root = np.sqrt(complex(damping**2 - 4 * mass * stiffness))
    s, z = (-damping + root) / (2 * mass), (-damping - root) / (2 * mass)
    if abs(s - z) < 1e-9 * abs(s):
        return np.asarray((amplitude * (1 - s * t) * np.exp(s * t)).real)
    return np.asarray((amplitude * (s * np.exp(z * t) - z * np.exp(s * t)) / (s - z)).real)


def coupled_oscillations(
    t: ArrayLike, mass: float, stiffness: float, start: tuple[float, float]
) -> Array:
    """Return the two displacements of masses between three equal springs [m]: (2, ...).

    m x'' = −K x with K = k [[2, −1], [−1, 2]]; by the eigenvectors of K.
    """
    matrix = stiffness / mass * np.array([[2.0, -1.0], [-1.0, 2.0]])
    squares, modes = np.linalg.eigh(matrix)
    swings = np.cos(np.sqrt(squares)[:, None] * np.asarray(t, dtype=float))
    return np.asarray(modes @ ((modes.T @ np.array(start))[:, None] * swings))


def skater_speed(t: ArrayLike, speed: float, draw: float) -> Array:
    """Return the speed of a hand 1 m from the axis that is drawn in at a constant rate [m/s].

    Across, v r is kept; along the arm it moves as it is drawn: √((v/r)² + u²) with r = 1 − u t.
    """
    r = 1 - draw * np.asarray(t, dtype=float)
    return np.asarray(np.sqrt((speed / r) ** 2 + draw**2))
