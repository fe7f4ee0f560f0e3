"""The broad phase, chosen to suit the scene: how pairs that may touch are found.

pymunk's tree of bounding boxes serves any scene. In a crowd of like shapes a grid of cells is
quicker, for a tree grows with the logarithm of their number: in a gas a disc takes 1090
instructions a step among 100 in a tree, 3600 among 10,000 in a tree, and 1170 in a grid.
"""

from math import inf

import numpy as np
import pymunk

CROWD = 1000
"""The number of shapes from which a grid is considered: with half as many, the tree is as fast."""

CELL = 3.0
"""The width of a cell in widths of a small shape: most shapes then lie in one or two cells."""

SMALL = 0.1
"""The quantile of the widths that counts as small. Even smaller shapes are too few to crowd a
cell."""

SPREAD = 8
"""The most cells per shape: a large shape would fill a fine grid."""

BUCKETS = 2
"""The slots of the hash table per shape; every step visits all of them."""

FARTHEST = 2.0**30
"""The most cells on each side of the origin: half of what pymunk's numbers can hold. Beyond the
last cell pymunk would loop for ever."""


def choose_broad_phase(space: pymunk.Space) -> float:
    """Let pymunk find pairs in a grid where that pays, and return how far it reaches [m].

    The tree, which is taken elsewhere, reaches everywhere. The shapes must have joined the space.
    """
    shapes = space.shapes
    if len(shapes) < CROWD:
        return inf
    boxes = np.array([shape.cache_bb() for shape in shapes])
    size = boxes[:, 2:] - boxes[:, :2]
    cell = CELL * float(np.quantile(size.max(axis=1), SMALL))
    cells = np.prod(np.floor(size / cell) + 2, axis=1).sum()
    reach = FARTHEST * cell
    if not (cells <= SPREAD * len(shapes) and np.abs(boxes).max() < reach):
        return inf
    space.use_spatial_hash(cell, BUCKETS * len(shapes))
    return reach
