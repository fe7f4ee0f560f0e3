"""The limit to pairs of bodies in reach of each other, checked before a space is filled.

pymunk needs 1 kB for each touching pair and visits all of them in each sweep of its solver: 2,000
discs in one place are two million pairs, which took 30 s and 2.7 GB.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.state.simulation_errors import SimulationError

MOST_PAIRS = 60_000
"""The most pairs in reach if there were no sweeps: their step takes a tenth of a second."""

SWEEPS = 100
"""So many sweeps of the solver over a pair take as long as finding it."""

MOST_DIRECT = 1000
"""The most pairs for the direct solver, where they form one dense system."""

MOST_HOLLOW = 1000
"""The most pairs of arcs, hoops and curves: a step of that many nested arcs takes 70 ms."""

BLOCK = 1_000_000
"""The number of pairs checked at once."""


def most_pairs(iterations: int, *, direct: bool) -> int:
    """Return the most pairs that may be in reach, given the sweeps of the solver."""
    return MOST_DIRECT if direct else int(MOST_PAIRS / (1 + iterations / SWEEPS))


def refuse_crowd(shapes: Mapping[str, Sequence[pymunk.Shape]], limit: int) -> None:
    """Refuse bodies with too many pairs, before their shapes are added to a space.

    Raises `SimulationError` if the bounding boxes of more than `limit` pairs overlap; it names the
    body with the most.
    """
    rows = np.repeat(np.arange(len(shapes)), [len(made) for made in shapes.values()])
    if len(rows) * (len(rows) - 1) // 2 <= limit:
        return
    every = [shape for made in shapes.values() for shape in made]
    corners = chain.from_iterable(shape.cache_bb() for shape in every)
    boxes = np.fromiter(corners, float).reshape(-1, 4)
    moves = np.array([_moves(shape) for shape in every])
    found = np.zeros(len(shapes), dtype=np.intp)
    for first, second in _meeting(boxes, rows, moves):
        found += np.bincount(rows[first], minlength=len(found))
        found += np.bincount(rows[second], minlength=len(found))
        if found.sum() > 2 * limit:
            name = list(shapes)[int(found.argmax())]
            raise SimulationError(name, 0.0, crowded(name, limit))


def _moves(shape: pymunk.Shape) -> bool:
    return shape.body is not None and shape.body.body_type != pymunk.Body.STATIC


def crowded(name: str, limit: int) -> Message:
    """Return the reason for refusing too many pairs; `name` is the body in most of them."""
    return Message(
        "more than {most:,} pairs of bodies are close to each other, too many for a step;"
        " '{name}' is in most of them: spread the bodies out",
        most=limit,
        name=name,
    )


def _meeting(boxes: Array, rows: Integers, moves: Booleans) -> Iterator[tuple[Integers, Integers]]:
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
