"""Force fields have a value where their bodies start."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cache, partial
from math import isfinite

import numpy as np

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.effects.field import Field
from sandbox.model.effects.potential import Potential
from sandbox.model.errors import brief
from sandbox.model.expressions import Array, Values
from sandbox.model.formulas import Function
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import evaluate


class _Starts:
    """The motion of some bodies at the start; the formulas of many fields ask for it."""

    def __init__(self, level: Level, names: Iterable[str]) -> None:
        self._bodies = {name: level.bodies[name] for name in names}
        self.bodies = list(self._bodies)
        motions = tuple((body.position, body.velocity) for body in self._bodies.values())
        self.names = names_in(motions)
        """The parameters and constants on which it depends."""
        self._known: tuple[Values, Mapping[str, Array]] = {}, {}

    def at(self, values: Values) -> Mapping[str, Array]:
        """Return the variables of a field, an array over the bodies each."""
        if values is not self._known[0] or not self._known[1]:
            motions = [
                (*evaluate(body.position, values), *evaluate(body.velocity, values), 0.0)
                for body in self._bodies.values()
            ]
            columns = np.array(motions).reshape(-1, 5).T
            self._known = values, dict(zip(("x", "y", "vx", "vy", "t"), columns, strict=True))
        return self._known[1]


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on the formulas of fields and potentials at the start."""
    dynamic = tuple(name for name, body in level.bodies.items() if body.type == "dynamic")
    starts = cache(partial(_Starts, level))
    for effect, place, said in level.effects.said:
        if effect.name not in ("field", "potential"):
            continue
        start = starts(dynamic if said.bodies is None else tuple(said.bodies))
        for path, formula in _formulas(said, place):
            needed = frozenset((formula.names | start.names) & level.parameters.keys())
            yield Condition(path, needed, partial(_lost, formula, start), 20 * len(start.bodies))


def _formulas(said: Field | Potential, place: Path) -> Iterator[tuple[Path, Function]]:
    """Yield the formulas that must have a value, including the gradient of a potential."""
    if isinstance(said, Field):
        yield from (((*place, "force", axis), part) for axis, part in enumerate(said.force))
    else:
        energy = said.energy
        slopes = (energy.slope("x"), energy.slope("y"))
        yield from (((*place, "energy"), formula) for formula in (energy, *slopes))


def _lost(formula: Function, start: _Starts, values: Values) -> Message | None:
    """Name the body at which it has no value, or too large a value."""
    try:
        found = np.broadcast_to(formula.at(values, start.at(values)), len(start.bodies))
    except ExpressionError as error:
        return error.message
    for name, value in zip(start.bodies, found.tolist(), strict=True):
        if not isfinite(value):
            return Message(
                "'{shown}' has no finite value where '{name}' starts",
                shown=brief(str(formula.source)),
                name=brief(name),
            )
        if beyond := formula.beyond(value):
            return Message(
                "'{shown}' is {found:g} where '{name}' starts, {beyond}",
                shown=brief(str(formula.source)),
                found=value,
                name=brief(name),
                beyond=beyond,
            )
    return None
