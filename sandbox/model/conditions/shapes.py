"""Every shape has an extent, and no corner too many."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.conditions.condition import Condition
from sandbox.model.level import Level
from sandbox.model.parts import names_in
from sandbox.model.shapes import fault


def conditions(level: Level) -> Iterator[Condition]:
    """Yield what must hold of a level's shapes."""
    for name, body in level.bodies.items():
        yield Condition(("bodies", name, "shape"), names_in(body.shape), partial(fault, body.shape))
