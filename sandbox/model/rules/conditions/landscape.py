"""A landscape has bounds, and a height between them."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.errors import brief
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import Point, evaluate
from sandbox.model.view import Landscape


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's landscape."""
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
