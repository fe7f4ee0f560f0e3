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
    """Return the speed of landing [m/s], from the work of the coils and of the weight."""
    pushed = sqrt(p["v0"] ** 2 + 2 * COILS * p["F"] * WIDTH / MASS)
    return energy.landing_speed(pushed, G, START)


def reach(p: Values) -> float:
    """Return the position of landing [m], on a parabola from the end of the barrel."""
    slope = radians(p["angle"])
    top = START + BARREL * sin(slope)
    speed = sqrt(landing_speed(p) ** 2 - 2 * G * top)
    up, across = speed * sin(slope), speed * cos(slope)
    return BARREL * cos(slope) + across * (up + sqrt(up**2 + 2 * G * top)) / G
