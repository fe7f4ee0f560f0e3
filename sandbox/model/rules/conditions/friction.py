"""Static friction is at least as strong as kinetic friction."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.expressions import NonNegative, Values
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's coefficients of friction."""
    for path, kinetic, static in _coefficients(level):
        wrong = partial(_friction_fault, kinetic, static)
        yield Condition(path, kinetic.names | static.names, wrong)


def _coefficients(level: Level) -> Iterator[tuple[Path, NonNegative, NonNegative]]:
    """Yield each pair of a kinetic and a static coefficient of friction, with its path."""
    for name, body in level.bodies.items():
        if body.friction is not None and body.static_friction is not None:
            yield ("bodies", name, "static_friction"), body.friction, body.static_friction
    for index, pair in enumerate(level.effects.friction.pairs if level.effects.friction else ()):
        if pair.static is not None:
            yield ("effects", "friction", "pairs", index, "static"), pair.coefficient, pair.static


def _friction_fault(kinetic: NonNegative, static: NonNegative, values: Values) -> Message | None:
    sticks, slips = static(values), kinetic(values)
    if sticks < slips:
        return Message(
            "is {sticks:g}, less than the kinetic coefficient of {slips:g}",
            sticks=sticks,
            slips=slips,
        )
    return None
