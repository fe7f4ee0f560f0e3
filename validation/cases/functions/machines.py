"""The functions that the tables of `machines.toml` name under `own`."""

from math import cos, pi, radians, sqrt

from sandbox.model.expressions import Values
from validation.formulas import energy, machines

G = 9.81  # m/s²


def axle_load(axle: int, p: Values, _: object) -> float:
    """Return the load on an axle of the car [N]."""
    weights = [(200.0, 0.0), (40.0, 0.8), (p["load"], p["x"]), (15.0, -1.1), (15.0, 1.1)]
    return machines.axle_loads([(G * m, x) for m, x in weights], (-1.1, 1.1))[axle]


HELD = 3.7 - 0.28j  # m, where the stone lies on the arm


def arm_spin(p: Values, angle: float) -> float:
    """Return the angular velocity of the arm at an angle [rad/s]."""
    return machines.trebuchet_spin(
        pi + radians(p["start"]),
        angle,
        (20.0, 50.0 + 20.0 * 1.5**2, 1.5),
        0.9,
        (p["M"], 0.9),
        (p["m"], HELD),
        G,
    )


def drop(p: Values) -> float:
    """Return the drop of the ball [m]."""
    return 4.5 * (1 - cos(radians(p["angle"])))


AT, SHOT = -1.5 + 0.33j, 1.7 + 0.28j  # m, weight and ball on the plank


def struck(p: Values) -> float:
    """Return the angular velocity of the plank after the blow [rad/s]."""
    moments = 18.0 + p["m"] * AT.real**2 + p["ball"] * abs(SHOT) ** 2
    return machines.struck_spin(p["m"] * sqrt(2 * G * p["h"]), -AT.real, moments)


def marble_speed(turned: float, p: Values, _: object) -> float:
    """Return the speed after a turn round the spiral [m/s]."""
    start = machines.spiral(p["R"], 0.12, -radians(p["start"]))
    return energy.landing_speed(0.0, p["g"], (start - machines.spiral(p["R"], 0.12, turned)).imag)


def wire_force(turned: float, p: Values, _: object) -> float:
    """Return the force of the wire after a turn round the spiral [N]."""
    return machines.spiral_force(0.5, p["R"], 0.12, -radians(p["start"]), turned, p["g"])
