"""Every effect as a level may declare it, made from the schema: what is declared is swept."""

from collections.abc import Iterator
from typing import Any

from sandbox.model.effects import EFFECTS
from sandbox.model.reference_fields import NAMES
from sandbox.model.write_json_schema import grammar

Part = dict[str, Any]

BODIES = ("a", "b", "c")
SCHEMA = grammar()


def resolved(part: Part) -> Part:
    """Return a part of the schema, looked up if it is but a reference."""
    if "$ref" not in part:
        return part
    definition: Part = SCHEMA["$defs"][part["$ref"].rpartition("/")[2]]
    return definition


def examples(effect: str, number: float = 1.0) -> Iterator[Any]:
    """Yield what a level may say of an effect: as little as it can, all that it can, each choice.

    Every number is the one given; where it may be a formula of time, it is one in the last.
    """
    part = SCHEMA["$defs"]["Effects"]["properties"][effect]
    least = _value(part, number, full=False)
    for name in EFFECTS[effect].needs:
        least = _with(least, name, number)
    yield least
    yield _value(part, number, full=True)
    for name, inside in _fields(part).items():
        for choice in inside.get("enum", ()):
            yield _with(_value(part, number, full=True), name, choice)
        if "in the parameters and t." in _comments(inside):
            yield _with(_value(part, number, full=True), name, [f"{number}*sin(9*t)", "t"])
        if "in the parameters and x, y, vx, vy, t" in _comments(inside):
            formulas = [f"-{number}*vx*(2 + sin(y))", "cos(x)*sin(t)"]
            yield _with(_value(part, number, full=True), name, formulas)
        if "in the parameters and theta, omega, t" in _comments(inside):
            formula = f"{number}*sin(t) - omega/5 - sin(theta)"
            yield _with(_value(part, number, full=False), name, formula)
        if "in the parameters and x, y." in _comments(inside):
            yield _with(_value(part, number, full=True), name, f"{number}*sin(x + y**2/5)*x")


def idle(effect: str) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return the least that a level may say of an effect, without strength."""
    part = SCHEMA["$defs"]["Effects"]["properties"][effect]
    said = _value(part, 1.0, full=False)
    for name in EFFECTS[effect].strength:
        said = _with(said, name, _value(_fields(part)[name], 0.0, full=False))
    return said


def _fields(part: Part) -> dict[str, Part]:
    fields: dict[str, Part] = resolved(part.get("items", part))["properties"]
    return fields


def _comments(part: Part) -> str:
    return str([part, *(resolved(item) for item in part.get("prefixItems", ()))])


def _with(said: Any, name: str, value: object) -> Any:  # noqa: ANN401 (whatever JSON holds)
    one = said[0] if isinstance(said, list) else said
    changed = {**one, name: value}
    return [changed] if isinstance(said, list) else changed


def _two_bodies(found: Part) -> Part:
    """Return the second of two bodies that are named, another one than the first."""
    named = [name for name, value in found.items() if value == BODIES[0]]
    return dict(zip(named[1:], BODIES[1:], strict=False))


def _of_others(said: Any, shift: int) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return what is said of some bodies, said of those that follow them.

    Entries of a list are of different bodies: two charges of one body exert no force.
    """
    if isinstance(said, dict):
        return {key: _of_others(value, shift) for key, value in said.items()}
    if isinstance(said, list):
        return [_of_others(value, shift) for value in said]
    return BODIES[(BODIES.index(said) + shift) % len(BODIES)] if said in BODIES else said


def _value(part: Part, number: float, *, full: bool) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return a value that a part of the schema allows."""
    part = resolved(part)
    if "const" in part or "enum" in part:
        return part["const"] if "const" in part else part["enum"][0]
    if "oneOf" in part:
        return _value(part["oneOf"][0], number, full=full)
    if part["type"] == "object":
        names = part["properties"] if full else part.get("required", ())
        found = {name: _value(part["properties"][name], number, full=full) for name in names}
        return {**found, **_two_bodies(found)}
    if part["type"] == "array":
        if part.get(NAMES) in ("bodies", "couple"):
            return list(BODIES[: max(part.get("minItems", 1), 1)])
        items = part.get("prefixItems") or [part["items"]] * part.get("minItems", 0)
        return [_of_others(_value(item, number, full=full), i) for i, item in enumerate(items)]
    if part["type"] == "boolean" or "pattern" in part:
        return "named" if "pattern" in part else False
    if number and "in the parameters and x, y." in part.get("$comment", ""):
        return f"{number}*x"  # a potential that is the same everywhere gives no force
    return BODIES[0] if part.get(NAMES) == "body" else number
