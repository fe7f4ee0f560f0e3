"""A landscape has bounds, and a height between them."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.conditions.condition import Condition
from sandbox.model.errors import brief
from sandbox.model.expressions import Values
from sandbox.model.landscape import Landscape
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.shapes import Point, evaluate


def conditions(level: Level) -> Iterator[Condition]:
    """Yield what must hold of a level's landscape."""
    landscape = level.view.landscape
    if landscape is None:
        return
    path = ("view", "landscape")
    for axis, bounds in (("x", landscape.x), ("y", landscape.y)):
        yield Condition((*path, axis), names_in(bounds), partial(_bounds_fault, bounds))
    names = names_in((landscape.potential, landscape.x)) - {landscape.potential.variable}
    yield Condition((*path, "potential"), names, partial(_curve_fault, landscape), 50)


def _bounds_fault(bounds: Point, values: Values) -> str | None:
    low, high = evaluate(bounds, values)
    return None if low < high else f"must go up, but goes from {low:g} m to {high:g} m"


def _curve_fault(landscape: Landscape, values: Values) -> str | None:
    try:
        x, potential = landscape.curve(values)
    except ExpressionError as error:
        return str(error)
    lost = x[~np.isfinite(potential)]
    shown = brief(str(landscape.potential.source))
    return f"'{shown}' has no finite value at x = {lost[0]:g} m" if len(lost) else None
