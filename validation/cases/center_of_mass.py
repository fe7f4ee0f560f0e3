"""The functions that the tables of `center_of_mass.toml` name under `own`."""

from sandbox.model.expressions import Values


def carts(p: Values) -> list[tuple[float, float, float]]:
    """Return each cart's mass [kg], and its position [m] and velocity [m/s] at the start."""
    return [(p["m1"], -2.5, p["v1"]), (p["m2"], 0.0, 0.0), (p["m3"], 2.0, p["v3"])]
