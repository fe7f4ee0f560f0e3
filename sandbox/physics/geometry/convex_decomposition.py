"""Decomposes polygons into convex ones.

pymunk collides only convex polygons, and would silently fill the hollows of others. Its own
decomposition aborts the process on a bent bar of a few dozen corners, so this one clips ears
(Meisters 1975) and then removes every cut that is not needed (Hertel and Mehlhorn 1983).
"""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY

STRAIGHT = 1e-12
"""The turn of a corner, over the square of the extent, below which it counts as straight."""

Part = list[int]
"""The indices of a part's corners, counter-clockwise."""


def convex_parts(points: Sequence[XY]) -> list[list[XY]]:
    """Return convex polygons that make up a simple polygon, counter-clockwise."""
    corners = np.array(points, dtype=float)
    if twice_area(corners) < 0:
        corners = corners[::-1]
    whole = list(range(len(corners)))
    parts = [whole] if _is_convex(corners, whole) else _merged(corners, _triangles(corners))
    return [[(float(x), float(y)) for x, y in corners[part]] for part in parts]


def twice_area(corners: Array) -> float:
    """Return twice the area of a polygon, positive if its corners are counter-clockwise."""
    x, y = corners.T
    return float(x @ np.append(y[1:], y[0]) - y @ np.append(x[1:], x[0]))


def _triangles(corners: Array) -> list[Part]:
    """Cut off corners one by one, the one with the shortest cut first."""
    left, triangles = list(range(len(corners))), []
    while len(left) > 3:
        ring = corners[left]
        before, after = np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0)
        turns = _turn(before, ring, after)
        order = np.argsort(np.hypot(*(after - before).T), kind="stable")
        blunt = turns > 0
        ears = (int(k) for k in order[blunt[order]] if _is_ear(ring, turns, int(k)))
        flat = int(np.argmin(np.abs(turns)))  # by rounding, there may be only a straight corner
        k = next(ears, flat)
        triangles.append([left[k - 1], left[k], left[(k + 1) % len(left)]])
        del left[k]
    return [t for t in [*triangles, left] if _turn(*corners[t]) > 0]


def _is_ear(ring: Array, turns: Array, k: int) -> bool:
    """Return whether no other corner lies in the triangle of a corner and its neighbours."""
    count = len(ring)
    others = np.delete(np.arange(count), [k - 1, k, (k + 1) % count])
    points = ring[others[turns[others] <= 0]]  # if any corner does, a reflex one does
    a, b, c = ring[k - 1], ring[k], ring[(k + 1) % count]
    inside = (_turn(a, b, points) >= 0) & (_turn(b, c, points) >= 0) & (_turn(c, a, points) >= 0)
    return not inside.any()


def _merged(corners: Array, parts: list[Part]) -> list[Part]:
    """Remove every cut between two parts whose union is convex."""
    owner = {edge: part for part in parts for edge in _edges(part)}
    for i, j in list(owner):
        one, other = owner.get((i, j)), owner.get((j, i))
        if one is None or other is None:
            continue
        joined = _from(one, j)[:-1] + _from(other, i)[:-1]
        if _is_convex(corners, joined):
            owner.update(dict.fromkeys(_edges(joined), joined))
            del owner[i, j], owner[j, i]
    return list({id(part): part for part in owner.values()}.values())


def _edges(part: Part) -> list[tuple[int, int]]:
    return list(zip(part, [*part[1:], part[0]], strict=True))


def _from(part: Part, corner: int) -> Part:
    at = part.index(corner)
    return part[at:] + part[:at]


def _is_convex(corners: Array, part: Part) -> bool:
    ring = corners[part]
    turns = _turn(np.roll(ring, 1, axis=0), ring, np.roll(ring, -1, axis=0))
    extent = float(np.ptp(corners, axis=0).max())
    return bool((turns >= -STRAIGHT * extent**2).all())


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Return twice the area of the triangle a-b-c, positive if it is counter-clockwise."""
    ab, ac = b - a, c - a
    return np.asarray(ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0])
