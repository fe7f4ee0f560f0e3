"""Chooses the broad phase, which finds the pairs that may touch.

pymunk's tree of bounding boxes suits any scene. A grid of cells is faster for many shapes of
similar size, as the cost of a tree grows with the logarithm of their number: in a gas a disc takes
1090 instructions a step among 100 in a tree, 3600 among 10,000 in a tree, and 1170 in a grid.
"""

from collections.abc import Sequence
from math import inf

import numpy as np
import pymunk

CROWD = 1000
"""The smallest number of shapes for a grid; with half as many, a tree is as fast."""

CELL = 3.0
"""The width of a cell over that of a small shape, such that most shapes lie in one or two cells."""

SMALL = 0.1
"""The quantile of the widths that counts as small; even smaller shapes are too few to crowd a
cell."""

SPREAD = 8
"""The largest mean number of cells for each shape, as a large shape would fill a fine grid."""

BUCKETS = 2
"""The slots of the hash table for each shape; every step visits all of them."""

FARTHEST = 2.0**30
"""The largest number of cells on each side of the origin, half of the range of pymunk's integers.
Beyond the last cell pymunk would loop for ever."""


GOLDEN = 0.618033988749895
"""Multiples of it, less whole numbers, spread evenly over 0 to 1."""


def add_shapes(space: pymunk.Space, shapes: Sequence[pymunk.Shape]) -> float:
    """Add all its shapes to a space, with a grid if that pays; return its reach from the origin.

    The reach of a tree is infinite [m]. The grid is chosen first, as a tree of shapes that are
    added in the order of their places is as deep as they are many: a row of 10,000 discs took 0.8 s
    to add. For the same reason a crowd is added to a tree in another order.
    """
    if len(shapes) >= CROWD:
        if cell := _cell(shapes):
            space.use_spatial_hash(cell, BUCKETS * len(shapes))
            space.add(*shapes)
            return FARTHEST * cell
        scattered = np.argsort(np.arange(len(shapes)) * GOLDEN % 1, kind="stable")
        shapes = [shapes[index] for index in scattered]
    space.add(*shapes)
    return inf


def _cell(shapes: Sequence[pymunk.Shape]) -> float | None:
    """Return the width of the cells of a grid [m], None if it does not pay."""
    boxes = np.array([shape.cache_bb() for shape in shapes])
    size = boxes[:, 2:] - boxes[:, :2]
    cell = CELL * float(np.quantile(size.max(axis=1), SMALL))
    cells = np.prod(np.floor(size / cell) + 2, axis=1).sum()
    if cells <= SPREAD * len(shapes) and np.abs(boxes).max() < FARTHEST * cell:
        return cell
    return None
