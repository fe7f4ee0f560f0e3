"""The rules of a level that go beyond the type of each part, over the ranges of its parameters.

Every rule is a generator of `Fault`: a path in the level and a message. All rules are run, so that
an author sees all mistakes at once. A rule on the values of the parameters is a `Condition` (see
`sandbox.model.rules.conditions`), and must hold at the corners of their ranges.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cache
from itertools import chain, islice, product

import numpy as np

from sandbox.model.errors import MAX_MISTAKES, brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault, expressions, instants
from sandbox.model.rules.conditions import conditions
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.consistency import contradictions, dangling, inconsistencies, too_much
from sandbox.model.translatable_message import Message

MAX_CORNERS = 256
"""The most corners of the parameters' ranges that are tried."""

FEWEST = 2
"""The number of corners that are tried of an expensive condition: all parameters at their minimum,
and all at their maximum."""

PATIENCE = 5e5
"""The work after which fewer corners are tried [µs]; it is counted, not timed, so that the result
is the same on every machine."""

EXHAUSTED = 3 * PATIENCE
"""The work after which expensive conditions are tried with the default values only [µs]."""


def faults(level: Level) -> list[Fault]:
    """Return all faults of a level; rules that depend on broken ones are skipped."""
    if found := _largest_count(too_much(level)):
        return found
    if next(dangling(level), None):
        return _largest_count(inconsistencies(level))
    return _largest_count(chain(contradictions(level), _values(level))) or _largest_count(
        _late(level)
    )


def _largest_count(found: Iterator[Fault]) -> list[Fault]:
    return list(islice(found, MAX_MISTAKES + 1))


def depending(level: Level) -> list[Condition]:
    """Return the conditions of a level that depend on its parameters."""
    return [condition for condition in conditions(level) if condition.names]


def broken(among: Iterable[Condition], values: Values) -> Iterator[Fault]:
    """Yield the faults of a level with given parameters."""
    for condition in among:
        if rule := condition.fault(values):
            yield Fault(condition.path, rule)


def corners(
    level: Level, names: Collection[str] | None = None, most: int = MAX_CORNERS
) -> Iterator[Values]:
    """Yield the default values, then combinations of the bounds of some parameters, or of all.

    The others keep their defaults. If there are more than `most` combinations, only some are
    yielded: all minima, all maxima, then each bound alone.
    """
    defaults = level.defaults
    yield defaults
    ranges = {n: (p.min, p.max) for n, p in level.parameters.items() if names is None or n in names}
    if ranges:
        yield from ({**defaults, **bounds} for bounds in islice(_bounds(ranges, most), most))


def _bounds(ranges: Mapping[str, tuple[float, float]], most: int) -> Iterator[Values]:
    if 2 ** len(ranges) <= most:
        for values in product(*ranges.values()):
            yield dict(zip(ranges, values, strict=True))
        return
    for side in (0, 1):
        yield {name: bounds[side] for name, bounds in ranges.items()}
    for name, bounds in ranges.items():
        for bound in bounds:
            yield {name: bound}


def _values(level: Level) -> Iterator[Fault]:
    """Every condition holds over the whole ranges of the parameters.

    For a level that would take too long, fewer combinations of bounds are tried, or none. Faults
    that this misses are reported when somebody chooses such values.
    """
    asked = list(conditions(level))
    tried = cache(lambda names, most: list(corners(level, names, most)))
    spared = sum(c.work * min(2 ** len(c.names), MAX_CORNERS) for c in asked) > PATIENCE
    varied = sum(1 for condition in asked if condition.names) or 1
    least = FEWEST if sum(c.work for c in asked if c.names) * FEWEST < EXHAUSTED else 0
    for condition in asked:
        most = int(PATIENCE / varied / condition.work) if spared else MAX_CORNERS
        count = most if most >= FEWEST else least
        for values in tried(condition.names, min(count, MAX_CORNERS)):
            if rule := condition.fault(values):
                used = ", ".join(f"{name} = {values[name]:g}" for name in sorted(condition.names))
                reported = Message("{rule} when {used}", rule=rule, used=used) if used else rule
                yield Fault(condition.path, reported)
                break


def _late(level: Level) -> Iterator[Fault]:
    yield from _formulas(level)
    yield from _instants(level)


def _formulas(level: Level) -> Iterator[Fault]:
    """Every formula that applies at some time has a value then, with the defaults."""
    values = level.defaults
    times = np.linspace(0, level.duration(values), 9)
    for path, formula in expressions(level):
        if isinstance(formula, Formula) and formula.variable == "t":
            try:
                lost = not np.isfinite(formula.over(values, times)).any()
                if lost and (path[-1] == "valid_if" or _applies(level, path, times)):
                    shown = brief(str(formula.source))
                    rule = Message(
                        "'{shown}' has no finite value with the parameters' default values",
                        shown=shown,
                    )
                    yield Fault(path, rule)
            except ExpressionError as error:
                yield Fault(path, error.message)


def _applies(level: Level, path: Path, times: Array) -> bool:
    """Whether the formula at a path applies with the defaults, at any of the times."""
    index = path[1]
    condition = level.checks[index].valid_if if isinstance(index, int) else None
    return condition is None or bool(condition.over(level.defaults, times).any())


def _instants(level: Level) -> Iterator[Fault]:
    """Every check or goal at a time is before the end."""
    duration = level.duration(level.defaults)
    for path, instant in instants(level):
        if isinstance(instant, Expression):
            at = instant(level.defaults)
            if not 0 <= at <= duration:
                rule = Message(
                    "is at {at:g} s, but the run lasts from 0 to {duration:g} s ('duration')",
                    at=at,
                    duration=duration,
                )
                yield Fault(path, rule)
