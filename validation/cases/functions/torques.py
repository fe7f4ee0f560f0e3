"""The functions that the tables of `torques.toml` name under `own`."""

from sandbox.model.expressions import Array, Values
from validation.formulas import rotation

BEAM, HALF = 3.0, 2.0  # kg, m


def net(p: Values) -> float:
    """Return the torque of the weights while the beam is level [N m]."""
    weights = ((-p["r1"], p["m1"]), (p["r2"], p["m2"]))
    return sum(rotation.torque(complex(arm), -1j * mass * p["g"]) for arm, mass in weights)


def inertia(p: Values) -> float:
    """Return the moment of inertia of the beam and its weights about the pin [kg m²]."""
    weights = ((p["r1"], p["m1"]), (p["r2"], p["m2"]))
    beam = rotation.rod_moment(BEAM, 2 * HALF)
    return beam + sum(rotation.round_moment(rotation.HOOP, mass, arm) for arm, mass in weights)


def turning(p: Values, _: Array) -> float:
    """Return the angular velocity, from the work of the weights, I ω² / 2 = τ [rad/s]."""
    torque = net(p)
    return (1 if torque > 0 else -1) * (2 * abs(torque) / inertia(p)) ** 0.5
