"""Conditions on a level's numbers, shapes and landscape."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.errors import brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions, names_in
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import Point, Polygon, Polyline, Segment, evaluate, fault, points_of
from sandbox.model.translatable_message import Message
from sandbox.model.view import Landscape

MAX_STEPS = 10_000_000
"""The most steps of a run: some minutes of computing."""


def numbers(level: Level) -> Iterator[Condition]:
    """Yield the conditions that every expression has a value, and no run is endless."""
    for path, expression in expressions(level):
        if expression.names_written and not expression.variables:
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


def shapes(level: Level) -> Iterator[Condition]:
    """Yield the conditions that every shape has an extent, and not too many corners."""
    for name, body in level.bodies.items():
        shape = body.shape
        corners = len(points_of(shape)) if isinstance(shape, Polygon | Segment | Polyline) else 0
        pairs = corners**2 if isinstance(shape, Polygon) else 0
        work = 1 + 8 * corners + pairs / 12  # two formulas per corner, and pairs of edges
        yield Condition(("bodies", name, "shape"), names_in(shape), partial(fault, shape), work)


def landscape(level: Level) -> Iterator[Condition]:
    """Yield the conditions that a landscape has bounds, and a height between them."""
    landscape = level.view.landscape
    if landscape is None:
        return
    path = ("view", "landscape")
    for axis, bounds in (("x", landscape.x), ("y", landscape.y)):
        yield Condition((*path, axis), names_in(bounds), partial(_bounds_fault, bounds))
    names = names_in((landscape.potential, landscape.x)) - {landscape.potential.variable}
    yield Condition((*path, "potential"), names, partial(_curve_fault, landscape), 50)


def _bounds_fault(bounds: Point, values: Values) -> Message | None:
    low, high = evaluate(bounds, values)
    if low < high:
        return None
    return Message("must increase, but goes from {low:g} m to {high:g} m", low=low, high=high)


def _curve_fault(landscape: Landscape, values: Values) -> Message | None:
    try:
        x, potential = landscape.curve(values)
    except ExpressionError as error:
        return error.message
    lost = x[~np.isfinite(potential)]
    if not len(lost):
        return None
    shown = brief(str(landscape.potential.source))
    return Message("'{shown}' has no finite value at x = {x:g} m", shown=shown, x=lost[0])
