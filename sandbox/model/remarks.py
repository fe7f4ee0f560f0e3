"""What a well-formed level declares for nothing: effects without strength, checks that never apply.

Effects are simulated as they stand, at their cost, and change nothing. A strength that is a
parameter may be zero for a while; this is about those that are zero whatever the parameters are.
"""

from collections.abc import Iterator
from contextlib import suppress

from sandbox.model.expressions import Expression, ExpressionError, Formula
from sandbox.model.level import Level
from sandbox.model.locating import Path
from sandbox.model.parts import Fault, expressions
from sandbox.model.rules import corners

STRENGTHS = {
    "gravity": "acceleration",
    "attraction": "mu",
    "gravitation": "constant",
    "centrifugal": "rate",
    "force": "force",
    "thrust": "exhaust",
    "belt": "velocity",
}
"""The field of an effect without which it does nothing; a drag without any is refused."""

SURFACES = ("friction", "restitution")
"""Effects whose strength is a coefficient of bodies and pairs."""


def remarks(level: Level) -> Iterator[Fault]:
    """Yield where an effect has no strength, or a check no case in which it applies."""
    yield from _without_strength(level)
    for index, check in enumerate(level.checks):
        if check.valid_if and not _ever_holds(check.valid_if, level):
            where = " with the default values, nor at the parameters' bounds"
            rule = (
                f"the check never applies: it does not hold{where if check.valid_if.names else ''}"
            )
            yield Fault(("checks", index, "valid_if"), rule)


def _ever_holds(condition: Formula, level: Level) -> bool:
    """Whether a condition holds with the default values or at a corner of the ranges."""
    for values in corners(level, condition.names):
        with suppress(ExpressionError):
            if condition(values):
                return True
    return False


def _without_strength(level: Level) -> Iterator[Fault]:
    for name, field in STRENGTHS.items():
        for path, effect in _declared(level, name):
            if _is_nothing(getattr(effect, field)):
                rule = (
                    f"{name!r} has no strength: it changes nothing, and is paid for; leave it out"
                )
                yield Fault((*path, field), rule)
    for name in SURFACES:
        effect = getattr(level.effects, name)
        coefficients = [getattr(body, name) for body in level.bodies.values()]
        if effect and _is_nothing((*coefficients, effect)):
            yield Fault(("effects", name), f"{name!r} has no strength: every coefficient is 0")


def _declared(level: Level, name: str) -> Iterator[tuple[Path, object]]:
    effect = getattr(level.effects, name)
    if isinstance(effect, tuple):
        yield from ((("effects", name, index), one) for index, one in enumerate(effect))
    elif effect is not None:
        yield ("effects", name), effect


def _is_nothing(part: object) -> bool:
    """Whether every number of a part is zero, whatever the parameters are."""
    return all(_is_zero(expression) for _, expression in expressions(part))


def _is_zero(expression: Expression) -> bool:
    return not expression.names and expression({}) == 0
