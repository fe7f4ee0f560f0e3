"""Conditions on a level over the whole ranges of its parameters."""

from collections.abc import Callable, Iterator
from itertools import chain

from sandbox.model.level import Level
from sandbox.model.rules.conditions import effects, joints, scene, whole_duration, wire_shapes
from sandbox.model.rules.conditions.condition import Condition

_TOPICS: tuple[Callable[[Level], Iterator[Condition]], ...] = (
    scene.numbers,
    scene.shapes,
    joints.conditions,
    scene.landscape,
    effects.fields,
    effects.friction,
    effects.singular_forces,
    effects.rockets,
    whole_duration.conditions,
    wire_shapes.conditions,
)


def conditions(level: Level) -> Iterator[Condition]:
    """Yield all conditions on a level's parameters."""
    yield from chain.from_iterable(topic(level) for topic in _TOPICS)
