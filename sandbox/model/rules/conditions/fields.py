"""Force fields have a value where their bodies start."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.body import Body
from sandbox.model.effects.field import Field
from sandbox.model.effects.potential import Potential
from sandbox.model.errors import brief
from sandbox.model.expressions import Values
from sandbox.model.formulas import Function
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import evaluate


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on the formulas of fields and potentials at the start."""
    for effect, place, said in level.effects.said:
        if effect.name not in ("field", "potential"):
            continue
        dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
        names = dynamic if said.bodies is None else said.bodies
        bodies = {name: level.bodies[name] for name in names}
        starts = names_in(tuple((b.position, b.velocity) for b in bodies.values()))
        for path, formula in _formulas(said, place):
            needed = frozenset((formula.names | starts) & level.parameters.keys())
            yield Condition(path, needed, partial(_lost, formula, bodies), 20 * len(bodies))


def _formulas(said: Field | Potential, place: Path) -> Iterator[tuple[Path, Function]]:
    """Yield the formulas that must have a value, including the gradient of a potential."""
    if isinstance(said, Field):
        yield from (((*place, "force", axis), part) for axis, part in enumerate(said.force))
    else:
        energy = said.energy
        slopes = (energy.slope("x"), energy.slope("y"))
        yield from (((*place, "energy"), formula) for formula in (energy, *slopes))


def _lost(formula: Function, bodies: dict[str, Body], values: Values) -> Message | None:
    """Name the body at which it has no value, or too large a value."""
    for name, body in bodies.items():
        (x, y), (vx, vy) = evaluate(body.position, values), evaluate(body.velocity, values)
        start = {"x": x, "y": y, "vx": vx, "vy": vy, "t": 0.0}
        try:
            found = float(formula.at(values, {n: np.asarray(v) for n, v in start.items()}))
        except ExpressionError as error:
            return error.message
        shown = brief(str(formula.source))
        if not np.isfinite(found):
            return Message(
                "'{shown}' has no finite value where '{name}' starts", shown=shown, name=brief(name)
            )
        if beyond := formula.beyond(found):
            return Message(
                "'{shown}' is {found:g} where '{name}' starts, {beyond}",
                shown=shown,
                found=found,
                name=brief(name),
                beyond=beyond,
            )
    return None
