"""The functions that the tables of `mechanisms.toml` name under `own`."""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.formulas import mechanisms, rotation

G = 9.81  # m/s²


def rise(p: Values, t: Array) -> Array:
    """Return the acceleration of the crane's load [m/s²]; its speed is v sin² (π t / 3)."""
    return np.asarray(p["v"] * np.pi / 3 * np.sin(2 * np.pi * t / 3))


def cable(p: Values, t: Array) -> Array:
    """Return the tension of the crane's cable [N]."""
    return p["m"] * (G + rise(p, t))


def stay(p: Values, t: Array) -> Array:
    """Return the tension of the stay [N]: of beam, trolley, drum and cable about the pin."""
    twist = rotation.round_moment(rotation.DISC, 40.0, 0.3) * rise(p, t) / 0.3
    weights = G * (400 * 4 + (50 + 40) * (p["r"] - 0.4))
    torque = weights + cable(p, t) * (p["r"] + 0.3 - 0.4) + twist
    return mechanisms.stay_tension(torque, 0.4 + 9j, 6.8 + 9j, 12j)


def back_stay(p: Values, _: Array) -> Array:
    """Return the tension of the back stay [N]."""
    torque = G * (200 * 2 + p["C"] * 3.2)
    return mechanisms.stay_tension(torque, -0.4 + 9j, -3.6 + 9j, 12j)


def feet(p: Values, t: Array) -> list[Array]:
    """Return the loads on the two feet [N]; a couple of forces 1 m apart turns the drum."""
    parts = ((-2, 50), (2, 50), (0, 1800), (4.4, 400), (-2.4, 200), (-3.6, p["C"]), (p["r"], 90))
    twist = rotation.round_moment(rotation.DISC, 40.0, 0.3) * rise(p, t) / 0.3
    weights = [(x, np.full_like(t, G * mass)) for x, mass in parts]
    moving = [(p["r"] + 0.3, cable(p, t)), (1.0, twist), (0.0, -twist)]
    return mechanisms.supports([*weights, *moving], -2.0, 2.0)


def rate(p: Values) -> float:
    """Return the rate of the motor [rad/s]."""
    return float(p["rpm"] * np.pi / 30)


def piston(p: Values, t: Array) -> mechanisms.Slider:
    """Return the position, velocity and acceleration of the piston."""
    return mechanisms.slider(rate(p) * t, rate(p), p["r"], p["l"])


def wheel(p: Values) -> float:
    """Return the moment of inertia of the flywheel [kg m²]."""
    return rotation.round_moment(rotation.DISC, p["M"], p["r"] + 0.1)


def sine(p: Values, name: str) -> float:
    """Return the sine of a parameter in degrees."""
    return float(np.sin(np.radians(p[name])))


def ram(p: Values, t: Array) -> Array:
    """Return the pull of the lift's ram [N]."""
    way, speed, change = mechanisms.eased(t / p["T"])
    wide, narrow = (2 * np.cos(np.radians(p[name])) for name in ("low", "high"))
    lift = mechanisms.Scissor(3, 2.0, 10.0, p["m"] + 20)
    less = narrow - wide
    return lift.force(wide + less * way, less * speed / p["T"], less * change / p["T"] ** 2, G)


def foot(ahead: float, part: Callable[[Array], Array], p: Values, t: Array) -> Array:
    """Return the position of a foot; the motor has turned by ∫ ω (1 − e^(−3 t)) dt."""
    turned = rate(p) * (t + np.expm1(-3 * t) / 3)
    return part(mechanisms.chebyshev_foot(ahead + turned, p["a"]))


def tension(row: int, p: Values, t: Array) -> Array:
    """Return the tension of a side of the belt, or the motor's torque; 2 × 20 g add mass."""
    grows = 3 * p["w"] * np.exp(-3 * t)
    wheel = rotation.round_moment(rotation.DISC, 2.0, p["b"]) * grows * p["a"] / p["b"]
    driver = rotation.round_moment(rotation.DISC, 2.0, p["a"]) * grows
    marks = rotation.round_moment(rotation.HOOP, 0.04, p["a"]) * grows
    return mechanisms.belt(
        p["torque"] + wheel, 300.0, (p["a"], p["b"]), 4.0, at_driver=driver + marks
    )[row]
