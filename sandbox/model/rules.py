"""What must hold in a level beyond the type of each part, and over the ranges of its parameters.

Every rule is a generator of `Fault`: a path into the level and what is wrong there. They are all
run, so that an author sees all mistakes at once. What depends on the values of the parameters is a
`Condition`, and must hold at the corners of their ranges.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from itertools import chain, islice, product
from typing import NamedTuple

import numpy as np

from sandbox.model.consistency import dangling, inconsistencies
from sandbox.model.effects import Gravitation
from sandbox.model.errors import MAX_MISTAKES, brief
from sandbox.model.expressions import (
    Array,
    Expression,
    ExpressionError,
    Formula,
    NonNegative,
    Positive,
    Values,
)
from sandbox.model.joints import Joint, Pivot, Pulley, Rod, Rope, bodies_of
from sandbox.model.landscape import Landscape
from sandbox.model.level import Level, span
from sandbox.model.locating import Path
from sandbox.model.parts import Fault, expressions, names_in
from sandbox.model.shapes import Point, Shape, evaluate, fault

MAX_CORNERS = 256
"""How many combinations of the parameters' bounds are tried at the most."""


MAX_STEPS = 10_000_000
"""How long a run may be: some minutes of computing."""

NEAR = 1e-9
"""How far apart two lengths may be that are meant to be the same, of the whole or in m."""


class Condition(NamedTuple):
    """What must hold for every choice of the parameters."""

    path: Path
    names: frozenset[str]
    """The parameters that it depends on."""
    broken: Callable[[Values], str | None]
    """Say what is wrong for the given parameters, if anything is."""


def faults(level: Level) -> list[Fault]:
    """Return everything that is wrong with a level, as far as it makes sense to look."""
    if next(dangling(level), None):
        return _most(inconsistencies(level))
    return _most(chain(inconsistencies(level), _values(level))) or _most(_late(level))


def _most(found: Iterator[Fault]) -> list[Fault]:
    return list(islice(found, MAX_MISTAKES + 1))


def broken(level: Level, values: Values) -> Iterator[Fault]:
    """Yield every part of a level that the given parameters make impossible."""
    for condition in _conditions(level):
        if condition.names and (rule := condition.broken(values)):
            yield Fault(condition.path, rule)


def corners(level: Level, names: Collection[str] | None = None) -> Iterator[Values]:
    """Yield the defaults, then what the bounds of the parameters combine to.

    Parameters
    ----------
    level
        Whose parameters.
    names
        The parameters that vary, the others keep their defaults; all if left out. Of more than
        eight not all combinations are tried, but each bound alone, and all of a side together.
    """
    defaults = level.defaults
    yield defaults
    ranges = {n: (p.min, p.max) for n, p in level.parameters.items() if names is None or n in names}
    if 2 ** len(ranges) <= MAX_CORNERS:
        for values in product(*ranges.values()):
            yield {**defaults, **dict(zip(ranges, values, strict=True))}
        return
    for side in (0, 1):
        yield {**defaults, **{name: bounds[side] for name, bounds in ranges.items()}}
        for name, bounds in ranges.items():
            yield {**defaults, name: bounds[side]}


def _values(level: Level) -> Iterator[Fault]:
    """Every condition holds over the whole ranges of the parameters."""
    for path, names, wrong in _conditions(level):
        for values in corners(level, names):
            if rule := wrong(values):
                used = ", ".join(f"{name} = {values[name]:g}" for name in sorted(names))
                yield Fault(path, f"{rule} when {used}" if used else rule)
                break


def _conditions(level: Level) -> Iterator[Condition]:
    for path, expression in expressions(level):
        if expression.names and not isinstance(expression, Formula):
            yield Condition(path, expression.names, partial(_value_fault, expression))
    yield Condition(("duration",), level.duration.names, partial(_too_long, level))
    for name, body in level.bodies.items():
        wrong = partial(_shape_fault, body.shape)
        yield Condition(("bodies", name, "shape"), names_in(body.shape), wrong)
    for name, joint in level.joints.items():
        held = [level.bodies[body] for body in bodies_of(joint)]
        names = names_in((joint, *((b.position, b.angle) for b in held))) - {"t"}
        last = "ends" if isinstance(joint, Pivot) else "length"
        yield Condition(("joints", name, last), names, partial(_span_fault, joint, level))
    if level.view.landscape:
        yield from _of_landscape(level.view.landscape)
    for path, kinetic, static in _coefficients(level):
        wrong = partial(_friction_fault, kinetic, static)
        yield Condition(path, kinetic.names | static.names, wrong)
    if pull := level.effects.gravitation:
        pulled = pull.bodies or [n for n, b in level.bodies.items() if b.type == "dynamic"]
        places = {name: level.bodies[name].position for name in pulled}
        names = names_in((pull.softening, *places.values()))
        wrong = partial(_meeting_fault, pull, places)
        yield Condition(("effects", "gravitation"), names, wrong)


def _of_landscape(landscape: Landscape) -> Iterator[Condition]:
    path = ("view", "landscape")
    for axis, bounds in (("x", landscape.x), ("y", landscape.y)):
        yield Condition((*path, axis), names_in(bounds), partial(_bounds_fault, bounds))
    names = names_in((landscape.potential, landscape.x)) - {landscape.potential.variable}
    yield Condition((*path, "potential"), names, partial(_curve_fault, landscape))


def _coefficients(level: Level) -> Iterator[tuple[Path, NonNegative, NonNegative]]:
    """Yield where two coefficients of friction stand, the kinetic and the static one."""
    for name, body in level.bodies.items():
        if body.friction is not None and body.static_friction is not None:
            yield ("bodies", name, "static_friction"), body.friction, body.static_friction
    for index, pair in enumerate(level.effects.friction.pairs if level.effects.friction else ()):
        if pair.static is not None:
            yield ("effects", "friction", "pairs", index, "static"), pair.coefficient, pair.static


def _friction_fault(kinetic: NonNegative, static: NonNegative, values: Values) -> str | None:
    try:
        sticks, slips = static(values), kinetic(values)
    except ExpressionError:
        return None  # the expression's own condition tells
    if sticks < slips:
        return f"is {sticks:g}, less than the kinetic coefficient, {slips:g}: what holds would slip"
    return None


def _value_fault(expression: Expression, values: Values) -> str | None:
    try:
        expression(values)
    except ExpressionError as error:
        return str(error)
    return None


def _too_long(level: Level, values: Values) -> str | None:
    try:
        steps = level.duration(values) * level.stepping.rate
    except ExpressionError:
        return None  # the expression's own condition tells
    return f"that takes {steps:.1g} steps; {MAX_STEPS:,} are allowed" if steps > MAX_STEPS else None


def _shape_fault(shape: Shape, values: Values) -> str | None:
    try:
        return fault(shape, values)
    except ExpressionError:
        return None  # the expression's own condition tells


def _span_fault(joint: Joint, level: Level, values: Values) -> str | None:
    try:
        distance = span(joint, level.bodies, values)
        match joint:
            case Rod(length=length):
                long = distance if length is None else float(length.over(values, np.zeros(())))
                return _rod_fault(distance, long)
            case Rope(length=Positive() as length) | Pulley(length=Positive() as length):
                return _string_fault(distance, length(values))
            case Pivot() if distance > NEAR:
                return f"a pivot's two points must be one, but they are {distance:g} m apart"
    except ExpressionError:
        return None  # the expression's own condition tells
    return None


def _rod_fault(distance: float, long: float) -> str | None:
    if not distance > NEAR:
        return "a rod cannot be 0 m long; a pivot keeps two points together"
    if not abs(long - distance) <= NEAR * distance:
        return f"the rod is {long:g} m long at the start, but its ends are {distance:g} m apart"
    return None


def _string_fault(path: float, long: float) -> str | None:
    if long < path * (1 - 1e-12):
        return f"the string is {long:g} m long, but its path is {path:g} m"
    return None


def _bounds_fault(bounds: Point, values: Values) -> str | None:
    try:
        low, high = evaluate(bounds, values)
    except ExpressionError:
        return None  # the expression's own condition tells
    return None if low < high else f"must go up, but goes from {low:g} m to {high:g} m"


def _curve_fault(landscape: Landscape, values: Values) -> str | None:
    try:
        x, potential = landscape.curve(values)
    except ExpressionError as error:
        return str(error)
    lost = x[~np.isfinite(potential)]
    shown = brief(str(landscape.potential.source))
    return f"'{shown}' has no finite value at x = {lost[0]:g} m" if len(lost) else None


def _meeting_fault(pull: Gravitation, places: Mapping[str, Point], values: Values) -> str | None:
    """Without softening there is no force between bodies at one place."""
    found: dict[tuple[float, float], str] = {}
    try:
        if pull.softening(values):
            return None
        for name, point in places.items():
            x, y = evaluate(point, values)
            other = found.setdefault((round(x, 9), round(y, 9)), name)
            if other != name:
                both = f"'{brief(other)}' and '{brief(name)}'"
                return f"{both} attract each other but start at one place; give them 'softening'"
    except ExpressionError:
        return None  # the expression's own condition tells
    return None


def _late(level: Level) -> Iterator[Fault]:
    yield from _formulas(level)
    yield from _instants(level)


def _formulas(level: Level) -> Iterator[Fault]:
    """Every formula has a value at some time, with the defaults, if it is said to apply then."""
    values = level.defaults
    times = np.linspace(0, level.duration(values), 9)
    for path, formula in expressions(level):
        if isinstance(formula, Formula) and formula.variable == "t":
            try:
                lost = not np.isfinite(formula.over(values, times)).any()
                if lost and (path[-1] == "valid_if" or _applies(level, path, times)):
                    shown = brief(str(formula.source))
                    rule = f"'{shown}' has no finite value with the parameters' default values"
                    yield Fault(path, rule)
            except ExpressionError as error:
                yield Fault(path, str(error))


def _applies(level: Level, path: Path, times: Array) -> bool:
    """Whether the formula at a path is said to hold with the defaults, at any of the times."""
    index = path[1]
    condition = level.checks[index].valid_if if isinstance(index, int) else None
    return condition is None or bool(condition.over(level.defaults, times).any())


def _instants(level: Level) -> Iterator[Fault]:
    """Every check at a time comes before the end."""
    duration = level.duration(level.defaults)
    for index, check in enumerate(level.checks):
        if isinstance(check.at, Expression):
            at = check.at(level.defaults)
            if not 0 <= at <= duration:
                rule = f"is at {at:g} s, but the run lasts from 0 to {duration:g} s ('duration')"
                yield Fault(("checks", index, "at"), rule)
