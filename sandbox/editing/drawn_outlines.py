"""Outlines that are drawn: their area, their centre, and the simplification of strokes."""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY


def centroid(points: Sequence[XY]) -> tuple[float, XY]:
    """Return the area of a simple polygon [m²], and its centroid [m]."""
    corners = np.array(points, dtype=float)
    start = corners[0]
    one = corners - start  # near the origin, so that nothing cancels
    other = np.roll(one, -1, axis=0)
    cross = one[:, 0] * other[:, 1] - other[:, 0] * one[:, 1]
    area = float(cross.sum()) / 2
    if area == 0:
        return 0.0, points[0]
    x, y = start + (one + other).T @ cross / (6 * area)
    return abs(area), (float(x), float(y))


def simplified(points: Sequence[XY], tolerance: float, *, closed: bool) -> list[XY]:
    """Return a line through some of the points, with all others within a tolerance of it.

    Ramer (1972), Douglas and Peucker (1973). A closed line is split at the point farthest from its
    start.
    """
    line = np.array(points, dtype=float)
    if not closed:
        return _listed(line[_kept(line, tolerance)])
    line = np.vstack((line, line[:1]))
    farthest = int(np.hypot(*(line - line[0]).T).argmax())
    outward, back = line[: farthest + 1], line[farthest:]
    corners = np.vstack(
        (outward[_kept(outward, tolerance)][:-1], back[_kept(back, tolerance)][:-1])
    )
    deviations = np.hypot(*(corners - np.roll(corners, 1, axis=0)).T) > tolerance
    return _listed(corners[deviations] if deviations.sum() >= 3 else corners)


def _kept(line: Array, tolerance: float) -> list[int]:
    """Return the indices of the points of a line that are kept, in order."""
    indices, pending = {0, len(line) - 1}, [(0, len(line) - 1)]
    while pending:
        first, last = pending.pop()
        away = _distances(line[first + 1 : last], line[first], line[last])
        if away.size and away.max() > tolerance:
            middle = first + 1 + int(away.argmax())
            indices.add(middle)
            pending += [(first, middle), (middle, last)]
    return sorted(indices)


def _distances(points: Array, start: Array, end: Array) -> Array:
    """Return the distances of points from the segment between two others."""
    along = end - start
    square = float(along @ along)
    fractions = (
        np.clip((points - start) @ along / square, 0, 1) if square else np.zeros(len(points))
    )
    return np.hypot(*(points - start - fractions[:, None] * along).T)


def _listed(line: Array) -> list[XY]:
    return [(float(x), float(y)) for x, y in line]
