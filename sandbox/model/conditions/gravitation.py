"""Bodies that attract each other start apart."""

from collections.abc import Iterator, Mapping
from functools import partial

from sandbox.model.conditions.condition import Condition
from sandbox.model.effects import Gravitation
from sandbox.model.errors import brief
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.parts import names_in
from sandbox.model.shapes import Point, evaluate


def conditions(level: Level) -> Iterator[Condition]:
    """Yield what must hold of a level's attraction between bodies."""
    if pull := level.effects.gravitation:
        pulled = pull.bodies or [n for n, b in level.bodies.items() if b.type == "dynamic"]
        places = {name: level.bodies[name].position for name in pulled}
        names = names_in((pull.softening, *places.values()))
        wrong = partial(_meeting_fault, pull, places)
        yield Condition(("effects", "gravitation"), names, wrong)


def _meeting_fault(pull: Gravitation, places: Mapping[str, Point], values: Values) -> str | None:
    """Without softening there is no force between bodies at one place."""
    found: dict[tuple[float, float], str] = {}
    if pull.softening(values):
        return None
    for name, point in places.items():
        x, y = evaluate(point, values)
        other = found.setdefault((round(x, 9), round(y, 9)), name)
        if other != name:
            both = f"'{brief(other)}' and '{brief(name)}'"
            return f"{both} attract each other but start at one place; give them 'softening'"
    return None
