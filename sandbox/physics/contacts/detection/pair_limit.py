"""The limit to pairs of bodies in reach of each other, checked before a space is filled.

pymunk needs 1 kB for each touching pair and visits all of them in each sweep of its solver: 2,000
discs in one place are two million pairs, which took 30 s and 2.7 GB.
"""

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np
import pymunk

from sandbox.model.translatable_message import Message
from sandbox.physics.engine.shape_pairs import meeting
from sandbox.physics.state.simulation_errors import SimulationError

MOST_PAIRS = 60_000
"""The most pairs in reach if there were no sweeps: their step takes a tenth of a second."""

SWEEPS = 100
"""So many sweeps of the solver over a pair take as long as finding it."""

MOST_DIRECT = 1000
"""The most pairs for the direct solver, where they form one dense system."""

MOST_HOLLOW = 1000
"""The most pairs of arcs, hoops and curves: a step of that many nested arcs takes 70 ms."""


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
    for first, second in meeting(boxes, rows, moves):
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
