"""Reads numbers that people type: arithmetic, with or without a unit."""

import re
from collections.abc import Mapping
from math import pi

from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.translatable_message import Message, either

FACTORS: Mapping[str, Mapping[str, float]] = {
    "rad": {"deg": pi / 180, "°": pi / 180},
    "deg": {"°": 1.0, "rad": 180 / pi},
    "rad/s": {"deg/s": pi / 180, "°/s": pi / 180},
    "m": {"mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "kg": {"g": 1e-3, "t": 1e3},
    "s": {"ms": 1e-3, "min": 60.0},
    "m/s": {"cm/s": 1e-2, "km/h": 1 / 3.6},
    "J": {"mJ": 1e-3, "kJ": 1e3},
    "N": {"mN": 1e-3, "kN": 1e3},
}
"""For each unit, others in which a number may be typed, with their values in that unit."""

SPACES = re.compile(r"(?<=\d)\s+(?=\d{3}(?!\d))|(?<=\d)\s+(?=\.\d)|(?<=\d\.)\s+(?=\d)")
"""spaces within a number: before a group of three digits, or beside a decimal point"""


def read(typed: str, unit: str, values: Values) -> float:
    """Return the value of a typed number, in a unit.

    The text is an arithmetic expression of the level's parameters, optionally followed by the
    unit or one of its `FACTORS`. Raises `ExpressionError` if the text is anything else.
    """
    if not typed.strip():
        raise ExpressionError("type a number first")
    typed = SPACES.sub("", typed)
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
        known_parameters = Message("there are no parameters")
        if values:
            known_parameters = Message("the parameters are {names}", names=", ".join(values))
        raise ExpressionError(
            "'{name}' is not known here; {known}", name=name, known=known_parameters
        )
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
