"""The questions that a level allows, and the reading of typed answers."""

import re
from collections.abc import Mapping
from math import pi

from sandbox.app.words.language import later, say
from sandbox.model.arithmetic import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import (
    ApexEvent,
    Check,
    ContactEvent,
    CrossingEvent,
    Instant,
    LandingEvent,
    Level,
    SeparationEvent,
)
from sandbox.model.message import Message, either
from sandbox.model.quantities import quantity
from sandbox.physics.measuring.grading import applies

FACTORS: Mapping[str, Mapping[str, float]] = {
    "rad": {"deg": pi / 180, "°": pi / 180},
    "rad/s": {"deg/s": pi / 180, "°/s": pi / 180},
    "m": {"mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "s": {"ms": 1e-3, "min": 60.0},
    "m/s": {"cm/s": 1e-2, "km/h": 1 / 3.6},
    "J": {"mJ": 1e-3, "kJ": 1e3},
    "N": {"mN": 1e-3, "kN": 1e3},
}
"""For each SI unit, other units in which a number may be typed, with their values in the SI
unit."""


def questions(level: Level, values: Values) -> tuple[Check, ...]:
    """Return the checks that apply and have an instant; if none has one, all at the end."""
    applying = [check for check in level.checks if applies(check, values)]
    timed = [check for check in applying if check.at is not None]
    if not timed:
        end = {"at": Expression(level.duration(values))}
        timed = [check.model_copy(update=end) for check in applying if check.quantity != "t"]
    return tuple({(check.quantity, check.at): check for check in reversed(timed)}.values())[::-1]


def when(at: Instant | None) -> str:
    """Return a description of an instant."""
    match at:
        case ApexEvent(body=body):
            return say("when {body} stops rising", body=body)
        case LandingEvent(body=body):
            return say("when {body} lands", body=body)
        case ContactEvent(bodies=(a, b), nth=nth):
            return say("just after {a} and {b} meet", a=a, b=b) + _again(nth)
        case SeparationEvent(bodies=(a, b), nth=nth):
            return say("when {a} and {b} part", a=a, b=b) + _again(nth)
        case CrossingEvent(quantity=name, value=value):
            message = later("when {quantity} first comes to {value}")
            return say(message, quantity=name, value=value.source)
        case Expression():
            return say("at t = {t} s", t=at.source)
    return ""


def _again(nth: int) -> str:
    if nth > 3:
        return say(", the {nth}th time", nth=nth)
    return ("", say(", the second time"), say(", the third time"))[nth - 1]


def unit_of(check: Check, level: Level) -> str:
    """Return the SI unit of the predicted quantity; empty if it has none."""
    return quantity(check.quantity, level).unit


def read(typed: str, unit: str, values: Values) -> float:
    """Return the value of a typed answer, in an SI unit.

    The answer is an arithmetic expression of the level's parameters, optionally followed by the
    unit or one of its `FACTORS`. Raises `ExpressionError` if the text is anything else.
    """
    if not typed.strip():
        raise ExpressionError("type a number first")
    try:
        return _value(typed, values)
    except ExpressionError as error:
        refusal = error
    units = {_plain(name): factor for name, factor in FACTORS.get(unit, {}).items()}
    units[_plain(unit)] = 1.0
    for place in range(1, len(typed)):
        factor = units.get(_plain(typed[place:]))
        if factor is not None and _is_arithmetic(typed[:place]):
            return _value(typed[:place], values) * factor
    raise _explained(refusal, typed, unit)


def _value(typed: str, values: Values) -> float:
    expression = Expression(typed.strip())
    for name in sorted(expression.names - values.keys()):
        known = Message("there are no parameters")
        if values:
            known = Message("the parameters are {names}", names=", ".join(values))
        raise ExpressionError("'{name}' is not known here; {known}", name=name, known=known)
    return expression(values)


def _is_arithmetic(typed: str) -> bool:
    try:
        Expression(typed.strip())
    except ExpressionError:
        return False
    return True


def _plain(unit: str) -> str:
    """Return the canonical form of a typed unit."""
    factors = re.sub(r"\s*/\s*", "/", unit.strip().replace("**", "").replace("^", ""))
    return re.sub(r"\s*[*·\s]\s*", "·", factors.replace("²", "2"))


def _explained(refusal: ExpressionError, typed: str, unit: str) -> ExpressionError:
    """Return the error, or one that names the allowed units if a number has another unit."""
    found = re.fullmatch(r"(.*[\d).])\s*([A-Za-z°µ][^()+-]*)", typed.strip())
    if found is None or not _is_arithmetic(found[1]):
        return refusal
    if not unit:
        message = Message("'{typed}': type a number without a unit", typed=found[2])
        return ExpressionError(message)
    allowed = either([unit, *FACTORS.get(unit, {})])
    message = Message(
        "'{typed}' is not a unit of this quantity: {allowed}", typed=found[2], allowed=allowed
    )
    return ExpressionError(message)
