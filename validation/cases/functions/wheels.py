"""The functions that the tables of `wheels.toml` name under `own`."""

from sandbox.model.expressions import Values
from validation.formulas import rotation


def drum_acceleration(p: Values) -> float:
    """Return the angular acceleration of the drum [rad/s²]."""
    discs = 2 * rotation.disc_moment(p["m"], 0.2, p["d"])
    moment = rotation.disc_moment(1.0, 0.3) + discs
    return rotation.driven_by_weight(p["weight"], 0.3, moment, p["g"])
