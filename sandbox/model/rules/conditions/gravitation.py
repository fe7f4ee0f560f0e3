"""Bodies start at a distance from what attracts them: each other, and fixed centres."""

from collections.abc import Iterator, Mapping
from functools import partial
from math import dist

from sandbox.model.effects.attraction import Attraction
from sandbox.model.effects.gravitation import Gravitation
from sandbox.model.errors import brief
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import Point, evaluate

NEAR = 1e-9
"""The distance below which positions count as equal [m]."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on the attraction between bodies, and to fixed centres."""
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    for index, center in enumerate(level.effects.attraction or ()):
        places = {name: level.bodies[name].position for name in dynamic}
        names = names_in((center.center, center.power, *places.values()))
        wrong = partial(_centre_fault, center, places)
        yield Condition(
            ("effects", "attraction", index, "center"), names, wrong, 10 + 5 * len(places)
        )
    if pull := level.effects.gravitation:
        pulled = pull.bodies or dynamic
        places = {name: level.bodies[name].position for name in pulled}
        names = names_in((pull.softening, *places.values()))
        wrong = partial(_meeting_fault, pull, places)
        yield Condition(("effects", "gravitation"), names, wrong, 10 + 5 * len(places))


def _meeting_fault(
    pull: Gravitation, places: Mapping[str, Point], values: Values
) -> Message | None:
    """Without softening, no force is defined between bodies at the same position."""
    found: dict[tuple[float, float], str] = {}
    if pull.softening(values):
        return None
    for name, point in places.items():
        x, y = evaluate(point, values)
        other = found.setdefault((round(x, 9), round(y, 9)), name)
        if other != name:
            return Message(
                "'{other}' and '{name}' attract each other but start at the same position; add"
                " a 'softening'",
                other=brief(other),
                name=brief(name),
            )
    return None


def _centre_fault(pull: Attraction, places: Mapping[str, Point], values: Values) -> Message | None:
    """No force is defined at a centre, unless it grows with the distance."""
    if pull.power(values) <= -1:
        return None
    x, y = evaluate(pull.center, values)
    for name, point in places.items():
        if dist(evaluate(point, values), (x, y)) <= NEAR:
            return Message(
                "'{name}' starts at the centre, where the attraction has no direction",
                name=brief(name),
            )
    return None
