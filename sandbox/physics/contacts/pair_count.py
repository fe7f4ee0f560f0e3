"""How many pairs of bodies may come close, estimated and limited before anything is made.

pymunk keeps 1 kB for each pair that touches and goes over all of them in each sweep of its solver:
2,000 discs in one place are two million pairs, which took 30 s and 2.7 GB.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.model.message import Message
from sandbox.physics.engine.batch import Booleans, Integers
from sandbox.physics.state.errors import SimulationError

MOST_PAIRS = 60_000
"""Pairs that a step can carry, each gone over once: it takes a tenth of a second."""

SWEEPS = 100
"""How many sweeps of the solver over a pair take as long as finding it."""

MOST_DIRECT = 1000
"""Pairs that can be solved directly: together, they make one dense system."""

BLOCK = 1_000_000
"""How many pairs are looked at in one go."""


def most_pairs(iterations: int, *, direct: bool) -> int:
    """Return how many pairs may be in reach, with so many sweeps of the solver."""
    return MOST_DIRECT if direct else int(MOST_PAIRS / (1 + iterations / SWEEPS))


def refuse_crowd(shapes: Mapping[str, Sequence[pymunk.Shape]], most: int) -> None:
    """Refuse bodies with more pairs than that, before their shapes join a space.

    Raises
    ------
    SimulationError
        If the boxes around more pairs of bodies meet; the body that is in most of them is told.
    """
    rows = np.repeat(np.arange(len(shapes)), [len(made) for made in shapes.values()])
    if len(rows) * (len(rows) - 1) // 2 <= most:
        return
    every = [shape for made in shapes.values() for shape in made]
    corners = chain.from_iterable(shape.cache_bb() for shape in every)
    boxes = np.fromiter(corners, float).reshape(-1, 4)
    moves = np.array([_moves(shape) for shape in every])
    found = np.zeros(len(shapes), dtype=np.intp)
    for first, second in _meeting(boxes, rows, moves):
        found += np.bincount(rows[first], minlength=len(found))
        found += np.bincount(rows[second], minlength=len(found))
        if found.sum() > 2 * most:
            name = list(shapes)[int(found.argmax())]
            raise SimulationError(name, 0.0, crowded(name, most))


def _moves(shape: pymunk.Shape) -> bool:
    return shape.body is not None and shape.body.body_type != pymunk.Body.STATIC


def crowded(name: str, most: int) -> Message:
    """Return why so many pairs are refused, of which a body is in most."""
    return Message(
        "more than {most:,} pairs of bodies are within reach of each other, which no step can"
        " carry; '{name}' is in most of them: spread the bodies out",
        most=most,
        name=name,
    )


def _meeting(boxes: Array, rows: Integers, moves: Booleans) -> Iterator[tuple[Integers, Integers]]:
    """Yield which boxes meet, of different bodies that do not both stand still, block by block.

    They are sorted along the axis on which fewer meet; then each is held against those that begin
    before it ends.
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
    """Return how many of those that come after each, (k,), begin before it ends."""
    return np.asarray(np.searchsorted(low, high, side="right") - np.arange(len(low)) - 1)


def _blocks(count: Sequence[int] | Integers) -> Iterator[tuple[int, int]]:
    """Yield from where to where about as many are counted as are looked at in one go."""
    ends = np.cumsum(count)
    start = 0
    while start < len(ends):
        before = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, before + BLOCK)), start + 1)
        yield start, stop
        start = stop
