"""Pairs of shapes that may touch, each found once, and what pymunk finds if they do.

`Space.shape_query` finds each pair twice, once from either shape, and takes 12 µs each time. Here a
pair takes 4 µs, read through pymunk's private handles; `Shape.shapes_collide` ends in an assertion
if two shapes do not touch.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pymunk
from pymunk._chipmunk_cffi import lib

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans, Integers

BLOCK = 1_000_000
"""The number of pairs checked at once."""


Filters = np.ndarray[tuple[int, ...], np.dtype[np.uint64]]
"""The group, categories and mask of each shape: (n, 3)."""


class Collision(NamedTuple):
    """What pymunk finds between two shapes that touch."""

    normal: complex
    """The unit normal from the first to the second; 0 if pymunk finds no direction to part in."""
    points: list[tuple[complex, complex]]
    """One or two contact points, each on the surface of the first and of the second [m]."""

    @property
    def depth(self) -> float:
        """The largest overlap [m]; pymunk's own distance has the wrong sign for swapped shapes."""
        x, y = self.normal.real, self.normal.imag
        return max((a.real - b.real) * x + (a.imag - b.imag) * y for a, b in self.points)


def collision(one: pymunk.Shape, other: pymunk.Shape) -> Collision | None:
    """Return how two shapes touch at their present positions, None if they do not."""
    found = lib.cpShapesCollide(one._shape, other._shape)  # noqa: SLF001
    if not found.count:
        return None
    normal, points = found.normal, found.points
    return Collision(
        complex(normal.x, normal.y),
        [
            (complex(p.pointA.x, p.pointA.y), complex(p.pointB.x, p.pointB.y))
            for p in (points[index] for index in range(found.count))
        ],
    )


def overlap(one: pymunk.Shape, other: pymunk.Shape) -> tuple[bool, float] | None:
    """Return whether two shapes have a direction to part in, and how deep they overlap [m].

    None if they do not touch. The numbers are those of a `Collision`, in a third of the time.
    """
    found = lib.cpShapesCollide(one._shape, other._shape)  # noqa: SLF001
    if not (count := found.count):
        return None
    x, y, points = found.normal.x, found.normal.y, found.points
    a, b = points[0].pointA, points[0].pointB
    depth = (a.x - b.x) * x + (a.y - b.y) * y
    if count > 1:
        a, b = points[1].pointA, points[1].pointB
        depth = max(depth, (a.x - b.x) * x + (a.y - b.y) * y)
    return bool(x or y), depth


def close_pairs(
    shapes: Sequence[pymunk.Shape], reach: float = 0.0, *, own: bool = False
) -> Iterator[tuple[pymunk.Shape, pymunk.Shape]]:
    """Yield pairs of shapes, in order, of which one is of a dynamic body and both may touch.

    Their bounding boxes, as last computed, are up to `reach` [m] apart, and their filters let them
    collide. `own` includes pairs of the same body.
    """
    boxes = np.array([shape.bb for shape in shapes]).reshape(-1, 4)
    boxes += (-reach / 2, -reach / 2, reach / 2, reach / 2)
    filters = np.array([shape.filter for shape in shapes], dtype=np.uint64).reshape(-1, 3)
    dynamic = np.array([is_dynamic(shape) for shape in shapes], dtype=bool)
    kinds: dict[object, int] = {}
    rows = [kinds.setdefault(index if own else s.body, index) for index, s in enumerate(shapes)]
    for first, second in meeting(boxes, np.array(rows, dtype=np.intp), dynamic):
        collide = _let_collide(filters[first], filters[second])
        pairs = np.sort(np.stack((first[collide], second[collide]), axis=1), axis=1)
        for a, b in pairs[np.lexsort(pairs.T[::-1])].tolist():
            yield shapes[a], shapes[b]


def is_dynamic(shape: pymunk.Shape) -> bool:
    """Return whether the body of a shape is dynamic."""
    return shape.body is not None and shape.body.body_type == pymunk.Body.DYNAMIC


def _let_collide(one: Filters, other: Filters) -> Booleans:
    """Return whether pymunk lets shapes with such filters collide: group, categories and mask."""
    same = (one[:, 0] == other[:, 0]) & (one[:, 0] != 0)
    met = ((one[:, 1] & other[:, 2]) != 0) & ((other[:, 1] & one[:, 2]) != 0)
    return np.asarray(met & ~same)


def meeting(boxes: Array, rows: Integers, moves: Booleans) -> Iterator[tuple[Integers, Integers]]:
    """Yield the pairs of overlapping boxes of different bodies, not both static, in blocks.

    The boxes are sorted along the axis with fewer overlaps; each is compared with those that begin
    before it ends (sweep and prune).
    """
    low, high = boxes[:, :2], boxes[:, 2:]
    orders = [np.argsort(low[:, axis], kind="stable") for axis in (0, 1)]
    counts = [_following(low[o, axis], high[o, axis]) for axis, o in enumerate(orders)]
    axis = int(counts[1].sum() < counts[0].sum())
    order, count = orders[axis], counts[axis]
    begin, end = low[order, 1 - axis], high[order, 1 - axis]
    for start, stop in _blocks(count):
        many = count[start:stop]
        first = np.repeat(np.arange(start, stop), many)
        second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(many) - many, many)
        meet = (begin[first] <= end[second]) & (begin[second] <= end[first])
        a, b = order[first[meet]], order[second[meet]]
        apart = (rows[a] != rows[b]) & (moves[a] | moves[b])
        yield a[apart], b[apart]


def _following(low: Array, high: Array) -> Integers:
    """Return the number of intervals after each, (k,), that begin before it ends."""
    return np.asarray(np.searchsorted(low, high, side="right") - np.arange(len(low)) - 1)


def _blocks(count: Sequence[int] | Integers) -> Iterator[tuple[int, int]]:
    """Yield ranges, start and stop, each with about `BLOCK` pairs."""
    ends = np.cumsum(count)
    start = 0
    while start < len(ends):
        before = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, before + BLOCK)), start + 1)
        yield start, stop
        start = stop
