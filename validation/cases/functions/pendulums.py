"""The functions that the tables of `pendulums.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.formulas import lagrange


def cart(p: Values, t: Array) -> Array:
    """Return the position of the cart; the centre of mass stays at 0."""
    start = -p["m"] * p["l"] * float(np.sin(amplitude(p))) / (p["M"] + p["m"])
    return start + lagrange.cart_pendulum(t, p["M"], p["m"], p["l"], 9.81, amplitude(p))[0]


def amplitude(p: Values) -> float:
    """Return the initial angle [rad]."""
    return float(np.radians(p["angle"]))


def lower(p: Values, t: Array) -> Array:
    """Return the horizontal position of the double pendulum's lower bob [m]."""
    start = amplitude(p), amplitude(p)
    theta, phi = lagrange.double_pendulum(t, (1.0, p["m"]), (1.0, 0.8), 9.81, start)
    return np.asarray(np.sin(theta) + 0.8 * np.sin(phi))


def sprung(p: Values, t: Array) -> Array:
    """Return the horizontal position of the spring pendulum's bob [m]."""
    r, theta = lagrange.spring_pendulum(t, 1.0, p["k"], 1.0, 9.81, amplitude(p))
    return np.asarray(r * np.sin(theta))


def double_energy(p: Values) -> float:
    """Return the energy of the double pendulum [J]."""
    height = -float(np.cos(amplitude(p)))
    upper = lagrange.pendulum_energy(1.0, 9.81, height)
    return upper + lagrange.pendulum_energy(p["m"], 9.81, 1.8 * height)
