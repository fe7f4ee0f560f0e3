"""The broad phase, chosen to suit the scene: how pairs that may touch are found.

pymunk's tree of bounding boxes serves any scene. In a crowd of like shapes a grid of cells is
quicker, for a tree grows with the logarithm of their number: in a gas a disc takes 1090
instructions a step among 100 in a tree, 3600 among 10,000 in a tree, and 1170 in a grid.
"""

from math import inf

import numpy as np
import pymunk

CROWD = 1000
"""From how many shapes on a grid is considered: with half of that the tree is as quick."""

CELL = 3.0
"""How wide a cell is, in widths of a small shape: then most shapes lie in one or two."""

SMALL = 0.1
"""The quantile of the widths that is a small one. Smaller ones are too few to crowd a cell."""

SPREAD = 8
"""How many cells there may be to a shape: a large shape in a fine grid would fill it."""

BUCKETS = 2
"""How many places of the hash table there are to a shape; each is visited in each step."""

FARTHEST = 2.0**30
"""How many cells there are on each side of the origin: half of those that pymunk has numbers for.
From the last one on, it goes through cells for ever."""


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
