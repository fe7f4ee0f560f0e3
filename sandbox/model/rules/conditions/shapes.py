"""Every shape has an extent, and not too many corners."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import Polygon, Polyline, Segment, fault, points_of


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's shapes."""
    for name, body in level.bodies.items():
        shape = body.shape
        corners = len(points_of(shape)) if isinstance(shape, Polygon | Segment | Polyline) else 0
        pairs = corners**2 if isinstance(shape, Polygon) else 0
        work = 1 + 8 * corners + pairs / 12  # two formulas per corner, and pairs of edges
        yield Condition(("bodies", name, "shape"), names_in(shape), partial(fault, shape), work)
