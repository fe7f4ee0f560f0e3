"""Conditions on a level over the whole ranges of its parameters."""

from collections.abc import Callable, Iterator
from itertools import chain

from sandbox.model.level import Level
from sandbox.model.rules.conditions import (
    effects,
    joints,
    numbers_and_shapes,
    time_dependent_formulas,
    wire_shapes,
)
from sandbox.model.rules.conditions.condition import Condition

_TOPICS: tuple[Callable[[Level], Iterator[Condition]], ...] = (
    numbers_and_shapes.numbers,
    numbers_and_shapes.shapes,
    joints.conditions,
    numbers_and_shapes.landscape,
    effects.fields,
    effects.friction,
    effects.singular_forces,
    effects.rockets,
    time_dependent_formulas.conditions,
    wire_shapes.conditions,
)


def conditions(level: Level) -> Iterator[Condition]:
    """Yield all conditions on a level's parameters."""
    yield from chain.from_iterable(topic(level) for topic in _TOPICS)
