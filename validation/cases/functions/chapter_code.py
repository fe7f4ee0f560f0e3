"""The functions that the tables of `chapter_code.toml` name under `own`."""

import numpy as np

from sandbox.model.expressions import Array, Values
from validation.formulas import chapter_code


def drop(p: Values) -> float:
    """Return the initial distance of the bob below its pin [m]."""
    return p["L"] * float(np.cos(p["start"]))


def plain(p: Values, t: Array) -> Array:
    """Return the angle by the chapter's plain Euler [rad]."""
    return chapter_code.swings(chapter_code.step_euler, p["start"], 0.0, p["L"], p["g"], t)


def symplectic(p: Values, t: Array) -> Array:
    """Return the chapter's angles, started so that its first kick, which comes first, cancels."""
    ahead = p["g"] / p["L"] * float(np.sin(p["start"])) * chapter_code.DT
    return chapter_code.swings(chapter_code.step_symplectic, p["start"], ahead, p["L"], p["g"], t)
