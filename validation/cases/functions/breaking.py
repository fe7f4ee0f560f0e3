"""The functions that `breaking.toml` names under `own`: a swing that ends where the vine breaks."""

from math import acos, cos, radians, sin, sqrt

from sandbox.model.expressions import Values

BRANCH = 10.0  # m, above the ground
MASS = 70.0  # kg
G = 9.81  # m/s²


def pull(p: Values, angle: float) -> float:
    """Return the tension at an angle from the lowest point [N].

    The weight along the vine and m v² / L, with v² = 2 g L (cos φ − cos φ₀).
    """
    start = radians(p["angle"])
    return MASS * G * cos(angle) + 2 * MASS * G * (cos(angle) - cos(start))


def across(p: Values) -> float:
    """Return the speed across with which the climber falls [m/s]."""
    angle = _breaks(p)
    return _speed(p, angle) * cos(angle)


def landing(p: Values, height: float) -> float:
    """Return the horizontal position at which the climber reaches a height [m]."""
    angle = _breaks(p)
    down = _speed(p, angle) * sin(angle)
    drop = BRANCH - p["L"] * cos(angle) - height
    time = 2 * drop / (down + sqrt(down**2 + 2 * G * drop))
    return -p["L"] * sin(angle) + across(p) * time


def _breaks(p: Values) -> float:
    """Return the angle from the lowest point at which the tension breaks the vine."""
    return acos(p["k"] / 3 + 2 * cos(radians(p["angle"])) / 3)


def _speed(p: Values, angle: float) -> float:
    return sqrt(2 * G * p["L"] * (cos(angle) - cos(radians(p["angle"]))))
