"""The functions that the tables of `center_of_mass.toml` name under `own`."""

from sandbox.model.expressions import Values


def carts(p: Values) -> list[tuple[float, float, float]]:
    """Return the mass [kg], initial position [m] and initial velocity [m/s] of each cart."""
    return [(p["m1"], -2.5, p["v1"]), (p["m2"], 0.0, 0.0), (p["m3"], 2.0, p["v3"])]
