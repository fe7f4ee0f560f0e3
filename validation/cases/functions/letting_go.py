"""The functions that the tables of `letting_go.toml` name under `own`: a swing, a parabola."""

from math import cos, radians, sin, sqrt

from scipy.integrate import quad

from sandbox.model.expressions import Values

RADIUS = 1.2  # m
CENTER = 1.8  # m, above the ground
G = 9.81  # m/s²


def _speed(p: Values, angle: float) -> float:
    """Return the speed of the hammer at an angle from the lowest point [m/s]."""
    return sqrt(p["v"] ** 2 - 2 * G * RADIUS * (1 - cos(angle)))


def across(p: Values) -> float:
    """Return the horizontal speed of the flight, which is constant up to the apex [m/s]."""
    angle = radians(p["angle"])
    return _speed(p, angle) * cos(angle)


def rise(p: Values) -> float:
    """Return the time from the release to the apex [s]."""
    angle = radians(p["angle"])
    return _speed(p, angle) * sin(angle) / G


def swing(p: Values) -> float:
    """Return the time of the swing before the release: ∫ R dφ / v(φ) [s]."""
    time, _ = quad(lambda angle: RADIUS / _speed(p, angle), 0, radians(p["angle"]))
    return float(time)


def height(p: Values) -> float:
    """Return the height of the apex [m]."""
    return CENTER - RADIUS * cos(radians(p["angle"])) + G * rise(p) ** 2 / 2
