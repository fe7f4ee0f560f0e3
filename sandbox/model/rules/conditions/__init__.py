"""Conditions on a level over the whole ranges of its parameters; a module for each topic."""

from collections.abc import Iterator
from itertools import chain

from sandbox.model.level import Level
from sandbox.model.rules.conditions import (
    fields,
    friction,
    gravitation,
    joints,
    landscape,
    massflow,
    numbers,
    shapes,
    whole_duration,
    wires,
)
from sandbox.model.rules.conditions.condition import Condition

_TOPICS = (
    numbers,
    shapes,
    joints,
    landscape,
    fields,
    friction,
    gravitation,
    massflow,
    whole_duration,
    wires,
)


def conditions(level: Level) -> Iterator[Condition]:
    """Yield all conditions on a level's parameters."""
    yield from chain.from_iterable(topic.conditions(level) for topic in _TOPICS)
