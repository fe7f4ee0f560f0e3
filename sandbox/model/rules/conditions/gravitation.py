"""Bodies start at a distance from those that act on them, and from fixed centres."""

from collections.abc import Iterator, Mapping
from functools import partial
from math import dist

from sandbox.model.effects.attraction import Attraction
from sandbox.model.effects.contract import Effect
from sandbox.model.errors import brief
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.consistency.mentions import bodies_of_effect
from sandbox.model.shapes import Point, evaluate

NEAR = 1e-9
"""The distance below which positions count as equal [m]."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on forces between bodies, and on attraction to fixed centres."""
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    for index, center in enumerate(level.effects.attraction or ()):
        places = {name: level.bodies[name].position for name in dynamic}
        names = names_in((center.center, center.power, *places.values()))
        wrong = partial(_centre_fault, center, places)
        yield Condition(
            ("effects", "attraction", index, "center"), names, wrong, 10 + 5 * len(places)
        )
    for effect, place, said in level.effects.said:
        if effect.singular:
            soft = getattr(said, effect.softening) if effect.softening else None
            places = {n: level.bodies[n].position for n in bodies_of_effect(level, said)}
            names = names_in((soft, *places.values()))
            wrong = partial(_meeting_fault, effect, soft, places)
            yield Condition(place, names, wrong, 10 + 5 * len(places))


def _meeting_fault(
    effect: Effect, soft: Expression | None, places: Mapping[str, Point], values: Values
) -> Message | None:
    """Without softening, no force is defined between bodies at the same position."""
    found: dict[tuple[float, float], str] = {}
    if soft is not None and soft(values):
        return None
    for name, point in places.items():
        x, y = evaluate(point, values)
        other = found.setdefault((round(x, 9), round(y, 9)), name)
        if other != name:
            return Message(
                "'{effect}' acts between '{other}' and '{name}', which start at the same position;"
                " {advice}",
                effect=effect.name,
                other=brief(other),
                name=brief(name),
                advice=_advice(effect),
            )
    return None


def _advice(effect: Effect) -> Message:
    if effect.softening:
        return Message("move one, or add a '{softening}'", softening=effect.softening)
    return Message("move one of them")


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
