"""Conditions on the effects of a level."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from math import isfinite

import numpy as np

from sandbox.model.effects.attraction import Attraction
from sandbox.model.effects.contract import Effect
from sandbox.model.effects.field import Field
from sandbox.model.effects.potential import Potential
from sandbox.model.errors import brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Expression, NonNegative, Positive, Values
from sandbox.model.functions_of_one_variable import Function
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.consistency.references_by_name import bodies_of_effect
from sandbox.model.shapes import Point, evaluate
from sandbox.model.translatable_message import Message

NEAR = 1e-9
"""The distance below which positions count as equal [m]."""

KEPT = 300
"""The most combinations of parameters for which the motions at the start are kept."""


class _Starts:
    """The motion of some bodies at the start; many fields and centres ask for it.

    Without `velocities`, these are zero: what does not need them is told even if one has no value.
    """

    def __init__(self, level: Level, names: Iterable[str], *, velocities: bool = True) -> None:
        bodies = {name: level.bodies[name] for name in names}
        self.bodies = list(bodies)
        self._motions = [
            (body.position, body.velocity) if velocities else (body.position,)
            for body in bodies.values()
        ]
        self.names = names_in(tuple(self._motions))
        """The parameters and constants on which it depends."""
        self._known: dict[int, tuple[Values, Mapping[str, Array]]] = {}

    def at(self, values: Values) -> Mapping[str, Array]:
        """Return the variables of a field, an array over the bodies each.

        Each condition asks for the same few mappings in turn.
        """
        if known := self._known.get(id(values)):
            return known[1]
        if len(self._known) == KEPT:
            self._known.clear()
        columns = np.zeros((5, len(self.bodies)))
        for column, motion in zip(columns.T, self._motions, strict=True):
            column[: 2 * len(motion)] = [
                part for point in motion for part in evaluate(point, values)
            ]
        found = dict(zip(("x", "y", "vx", "vy", "t"), columns, strict=True))
        self._known[id(values)] = values, found  # an identity holds as long as its mapping
        return found


def fields(level: Level) -> Iterator[Condition]:
    """Yield the conditions on the formulas of fields and potentials at the start."""
    dynamic = tuple(name for name, body in level.bodies.items() if body.type == "dynamic")
    starts = cache(partial(_Starts, level))
    for effect, effect_path, settings in level.effects.settings:
        if effect.name not in ("field", "potential"):
            continue
        start = starts(dynamic if settings.bodies is None else tuple(settings.bodies))
        for path, formula in _formulas(settings, effect_path):
            needed = frozenset((formula.names | start.names) & level.parameters.keys())
            yield Condition(path, needed, partial(_lost, formula, start), 20 * len(start.bodies))


def _formulas(settings: Field | Potential, effect_path: Path) -> Iterator[tuple[Path, Function]]:
    """Yield the formulas that must have a value, including the gradient of a potential."""
    if isinstance(settings, Field):
        yield from (
            ((*effect_path, "force", axis), part) for axis, part in enumerate(settings.force)
        )
    else:
        energy = settings.energy
        slopes = (energy.slope("x"), energy.slope("y"))
        yield from (((*effect_path, "energy"), formula) for formula in (energy, *slopes))


def _lost(formula: Function, start: _Starts, values: Values) -> Message | None:
    """Name the body at which it has no value, or too large a value."""
    try:
        found = np.broadcast_to(formula.at(values, start.at(values)), len(start.bodies))
    except ExpressionError as error:
        return error.message
    wrong = ~np.isfinite(found) | (np.abs(found) > formula.most)
    if not wrong.any():
        return None
    first = int(wrong.argmax())
    value, name = float(found[first]), start.bodies[first]
    if not isfinite(value):
        return Message(
            "'{shown}' has no finite value where '{name}' starts",
            shown=brief(str(formula.source)),
            name=brief(name),
        )
    return Message(
        "'{shown}' is {found:g} where '{name}' starts, {beyond}",
        shown=brief(str(formula.source)),
        found=value,
        name=brief(name),
        beyond=formula.range_fault(value),
    )


def friction(level: Level) -> Iterator[Condition]:
    """Yield the conditions that static friction is at least as strong as kinetic friction."""
    for path, kinetic, static in _coefficients(level):
        wrong = partial(_friction_fault, kinetic, static)
        yield Condition(path, kinetic.names | static.names, wrong)


def _coefficients(level: Level) -> Iterator[tuple[Path, NonNegative, NonNegative]]:
    """Yield each pair of a kinetic and a static coefficient of friction, with its path."""
    for name, body in level.bodies.items():
        if body.friction is not None and body.static_friction is not None:
            yield ("bodies", name, "static_friction"), body.friction, body.static_friction
    for index, pair in enumerate(level.effects.friction.pairs if level.effects.friction else ()):
        if pair.static is not None:
            yield ("effects", "friction", "pairs", index, "static"), pair.coefficient, pair.static


def _friction_fault(kinetic: NonNegative, static: NonNegative, values: Values) -> Message | None:
    sticks, slips = static(values), kinetic(values)
    if sticks < slips:
        return Message(
            "is {sticks:g}, less than the kinetic coefficient of {slips:g}",
            sticks=sticks,
            slips=slips,
        )
    return None


def singular_forces(level: Level) -> Iterator[Condition]:
    """Yield the conditions that bodies start away from those that act on them, and from centres."""
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    start = _Starts(level, dynamic, velocities=False)
    for index, center in enumerate(level.effects.attraction or ()):
        names = start.names | names_in((center.center, center.power))
        wrong = partial(_centre_fault, center, start)
        yield Condition(
            ("effects", "attraction", index, "center"), names, wrong, 10 + 5 * len(dynamic)
        )
    for effect, effect_path, settings in level.effects.settings:
        if effect.is_singular:
            soft = getattr(settings, effect.softening) if effect.softening else None
            positions = {n: level.bodies[n].position for n in bodies_of_effect(level, settings)}
            names = names_in((soft, *positions.values()))
            wrong = partial(_meeting_fault, effect, soft, positions)
            yield Condition(effect_path, names, wrong, 10 + 5 * len(positions))


def _meeting_fault(
    effect: Effect, soft: Expression | None, positions: Mapping[str, Point], values: Values
) -> Message | None:
    """Without softening, no force is defined between bodies at the same position."""
    found: dict[tuple[float, float], str] = {}
    if soft is not None and soft(values):
        return None
    for name, point in positions.items():
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


def _centre_fault(pull: Attraction, start: _Starts, values: Values) -> Message | None:
    """No force is defined at a centre, unless it grows with the distance."""
    if pull.power(values) <= -1:
        return None
    x, y = evaluate(pull.center, values)
    bodies = start.at(values)
    inside = np.hypot(bodies["x"] - x, bodies["y"] - y) <= NEAR
    if not inside.any():
        return None
    return Message(
        "'{name}' starts at the centre, where the attraction has no direction",
        name=brief(start.bodies[int(inside.argmax())]),
    )


def rockets(level: Level) -> Iterator[Condition]:
    """Yield the conditions that no rocket burns all of its mass."""
    thrusts = level.effects.thrust or ()
    for index, thrust in enumerate(thrusts):
        if mass := level.bodies[thrust.body].mass:
            burns = [other.propellant for other in thrusts if other.body == thrust.body]
            wrong = partial(_burnt_fault, thrust.body, mass, burns)
            path = ("effects", "thrust", index, "propellant")
            yield Condition(path, names_in((mass, *burns)), wrong)


def _burnt_fault(
    body: str, mass: Positive, burns: Sequence[Positive], values: Values
) -> Message | None:
    whole, burnt = mass(values), sum(propellant(values) for propellant in burns)
    if burnt >= whole:
        return Message(
            "'{body}' burns {burnt:g} kg, but its whole mass is {whole:g} kg",
            body=brief(body),
            burnt=burnt,
            whole=whole,
        )
    return None
