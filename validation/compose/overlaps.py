"""The overlaps of bodies in a run, and the overlaps that are allowed."""

import numpy as np

from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.expressions import Array
from validation.compose.body_distances import Couple
from validation.compose.recorded_run import Course

SKIN = 1.1e-6
"""The overlap that is always allowed [m]: the engine leaves 1e-6 m, approached from above."""

SOON = 0.25
"""The time within which the overlap of a late impact must vanish [s]."""

SLOWLY = 0.2
"""The share of an overlap that a step removes if contacts are pymunk's and nothing bounces; with
bounces it removes none (docs/how-to/write-a-level.md, `correction`). The rest may remain after that
time."""


def overlapped(couple: Couple) -> float:
    """Return the sum of the greatest depths of two bodies' successive overlaps [m]."""
    depth = np.maximum(-couple.separation, 0.0)
    begins = np.flatnonzero((depth > 0) & (np.concatenate(([0.0], depth[:-1])) == 0))
    return float(np.maximum.reduceat(depth, begins).sum()) if begins.size else 0.0


def excess(course: Course, couple: Couple, extents: Array) -> float:
    """Return the overlap of two bodies beyond what a recent impact explains [m].

    `extents` are the reach of the bodies from their centres: (n,) [m].
    """
    depth = np.maximum(-couple.separation, 0.0)
    if not (depth > SKIN).any():
        return float(depth.max())
    ways = _ways(course, couple, extents)
    allowance = np.zeros(len(depth))
    step = np.arange(len(depth))
    share = np.where(step <= SOON * course.rate, 1.0, _left(course) ** step)
    for at in np.flatnonzero(couple.entered(SKIN)):
        allowance[at:] = np.maximum(allowance[at:], ways[at] * share[: len(depth) - at])
    return float((depth - allowance).max())


def _left(course: Course) -> float:
    """Return the share of an overlap that a step leaves; 0 if it must vanish soon."""
    if is_direct(course.level):
        return 0.0
    return 1.0 if course.level.effects.restitution else 1 - SLOWLY


def _ways(course: Course, couple: Couple, extents: Array) -> Array:
    """Return the greatest possible approach of two bodies in each step: (T,) [m]."""
    seen, names = course.seen, list(course.scene.document["bodies"])
    a, b = (names.index(name) for name in couple.names)
    apart = np.diff(seen.position[:, a] - seen.position[:, b], axis=0)
    turn = sum(np.abs(np.diff(seen.angle[:, i])) * extents[i] for i in (a, b))
    return np.concatenate(([0.0], np.hypot(*apart.T) + turn))
