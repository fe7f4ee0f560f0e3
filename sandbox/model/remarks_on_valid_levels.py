"""Remarks on a well-formed level: effects without strength, checks that never apply, and the like.

Effects are simulated as declared, at their cost, even if they change nothing. A strength that is a
parameter may be zero at times; remarks are about those that are zero for all parameters.
"""

from collections.abc import Iterator
from contextlib import suppress

from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.events import rebounding_stops
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault, expressions
from sandbox.model.rules.level_validation import corners
from sandbox.model.translatable_message import Message


def remarks(level: Level) -> Iterator[Fault]:
    """Yield effects without strength, checks that never apply, and stops that are less exact."""
    yield from _without_strength(level)
    if level.changes_during_run and level.stepping.scheme == "leapfrog" and is_direct(level):
        for name, _ in rebounding_stops(level.joints):
            rule = Message(
                "'{name}' rebounds less exactly where bodies land in the same step, since the"
                " level has events or joints that break",
                name=name,
            )
            yield Fault(("joints", name, "restitution"), rule)
    for index, check in enumerate(level.checks):
        if check.valid_if and not _ever_holds(check.valid_if, level):
            rule = Message("the check never applies: its condition is false")
            if check.valid_if.names:
                rule = Message(
                    "the check never applies: its condition is false with the default values"
                    " and at the parameters' bounds"
                )
            yield Fault(("checks", index, "valid_if"), rule)


def _ever_holds(condition: Formula, level: Level) -> bool:
    """Whether a condition holds with the default values, or at a corner of the ranges."""
    for values in corners(level, condition.names):
        with suppress(ExpressionError):
            if condition(values):
                return True
    return False


def _without_strength(level: Level) -> Iterator[Fault]:
    for effect, path, settings in level.effects.settings:
        name = effect.name
        if effect.strength and _is_nothing(tuple(getattr(settings, f) for f in effect.strength)):
            rule = Message(
                "'{name}' has no strength: it changes nothing, but takes time; leave it out",
                name=name,
            )
            yield Fault((*path, effect.strength[0]), rule)
        if effect.coefficient:
            coefficients = tuple(getattr(body, name, None) for body in level.bodies.values())
            if _is_nothing((*coefficients, settings)):
                yield Fault(path, "'{name}' has no strength: every coefficient is 0", name=name)


def _is_nothing(part: object) -> bool:
    """Whether every number of a part is zero for all parameters."""
    return all(not one.names and one({}) == 0 for _, one in expressions(part))
