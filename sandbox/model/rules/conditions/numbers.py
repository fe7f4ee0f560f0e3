"""Every expression has a value, and no run is endless."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition

MAX_STEPS = 10_000_000
"""The most steps of a run: some minutes of computing."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's numbers."""
    for path, expression in expressions(level):
        if expression.written and not expression.variables:
            work = 3 + len(str(expression.source)) / 50
            yield Condition(path, expression.names, partial(_value_fault, expression), work)
    yield Condition(("duration",), level.duration.names, partial(_too_long, level))


def _value_fault(expression: Expression, values: Values) -> Message | None:
    try:
        expression(values)
    except ExpressionError as error:
        return error.message
    return None


def _too_long(level: Level, values: Values) -> Message | None:
    steps = level.duration(values) * level.stepping.rate
    if steps <= MAX_STEPS:
        return None
    return Message(
        "that takes {steps:.1g} steps; at most {most:,} are allowed", steps=steps, most=MAX_STEPS
    )
