"""The functions that the tables of `springs.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import lagrange


def quarter(against: bool) -> Expected:
    """Return the closed form of a quarter of a mode's period [s]."""
    return lambda p, _: np.pi / 2 / lagrange.mode_frequencies(p["m"], p["k"], p["k"])[against]


def beating(index: int) -> Expected:
    """Return the closed form of a beating oscillator's position [m]."""

    def expected(p: Values, t: Array) -> Array:
        swing = lagrange.coupled_oscillations(t, 1.0, p["k"], (p["a"], 0.0), p["c"])[index]
        return np.asarray(1.2 * index - 0.6 + swing)

    return expected


def coupled(index: int) -> Expected:
    """Return the closed form of a coupled oscillator's position [m]."""

    def expected(p: Values, t: Array) -> Array:
        swing = lagrange.coupled_oscillations(t, p["m"], p["k"], (p["a"], p["b"]))[index]
        return np.asarray(index - 0.5 + swing)

    return expected


def damped(damping: float) -> Expected:
    """Return the closed form of the position of a spring with some damping [m]."""

    def expected(p: Values, t: Array) -> Array:
        mass, stiffness = p.get("m", 2.0), p.get("k", 50.0)
        return 1 + lagrange.damped_oscillation(t, mass, stiffness, damping, p["A"])

    return expected
