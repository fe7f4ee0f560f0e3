"""The functions that the tables of `sensors.toml` name under `own`: a slug that coils throw."""

from math import cos, radians, sin, sqrt

from sandbox.model.expressions import Values
from validation.formulas import energy

MASS = 1.0  # kg
COILS, WIDTH = 4, 0.4  # m, each
BARREL = 2.6  # m, from the start to where it flies
START = 1.0  # m, above the ground
G = 9.81  # m/s²


def landing_speed(p: Values) -> float:
    """Return how fast it comes down [m/s]: the coils' work and that of its weight, whatever way."""
    pushed = sqrt(p["v0"] ** 2 + 2 * COILS * p["F"] * WIDTH / MASS)
    return energy.landing_speed(pushed, G, START)


def reach(p: Values) -> float:
    """Return where it comes down [m]: a parabola from the end of the barrel."""
    slope = radians(p["angle"])
    top = START + BARREL * sin(slope)
    speed = sqrt(landing_speed(p) ** 2 - 2 * G * top)
    up, across = speed * sin(slope), speed * cos(slope)
    return BARREL * cos(slope) + across * (up + sqrt(up**2 + 2 * G * top)) / G
