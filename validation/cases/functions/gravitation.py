"""The functions that the tables of `gravitation.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import energy

G = 4.0  # m³/(kg s²), in the levels of two and of three bodies
NEAR = 1.5  # m, the perihelion of the orbit that turns


def heavy(p: Values, t: Array) -> Array:
    """Return the height of the heavy star [m]."""
    turn = 2 * np.pi * t / energy.two_body_period(p["m1"], p["m2"], G, p["d"])
    return np.asarray(-p["m2"] / (p["m1"] + p["m2"]) * p["d"] * np.sin(turn))


def star(row: int) -> Expected:
    """Return the closed form of a star's horizontal position [m]."""
    return lambda p, t: energy.figure_eight(p["m"], G, p["a"], t)[2 * row]


def revolving(p: Values, t: Array) -> tuple[Array, Array]:
    """Return the distance [m] and angle [rad] of the planet."""
    extra = p["share"] / (1 - p["share"]) * p["mu"] * NEAR * (1 + p["e"])
    return energy.revolving_place(NEAR, p["e"], p["mu"], extra, t)


def revolving_height(p: Values, t: Array) -> Array:
    """Return the planet's height [m]; the level starts three perihelia before angle 0."""
    r, angle = revolving(p, t)
    return r * np.sin(angle - 6 * np.pi / np.sqrt(1 - p["share"]))
