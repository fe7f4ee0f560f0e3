"""The functions that the tables of `cradles.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Values


def lifted(p: Values) -> float:
    """Return the energy of a ball that is drawn aside [J]."""
    return p["g"] * p["L"] * float(1 - np.cos(np.radians(p["angle"])))
