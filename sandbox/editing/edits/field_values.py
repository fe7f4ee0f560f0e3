"""Setting any field of a level, and turning a number into a parameter."""

import json
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from math import floor, isfinite, log10

from sandbox.editing.bodies_at_start import placed
from sandbox.editing.cleanup_after_edit import COEFFICIENTS, accepted, without_meaning
from sandbox.editing.edits.bodies import DENSITY
from sandbox.editing.edits.effects import declare
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import PatchError, put, put_all, remove, shown, type_in, value_at
from sandbox.model.errors import LevelError, Mistake, SandboxError
from sandbox.model.expressions import Expression, Fraction
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.loading import parse
from sandbox.model.translatable_message import Message

_NUMBER = re.compile(r"-?(0|[1-9]\d*)(\.\d+)?([eE][+-]?\d+)?")
"""A number as JSON writes it."""

_MEANT_BY: Mapping[str, str] = {
    **{name: name for name in COEFFICIENTS},
    "static_friction": "friction",
    "moment": "rotation",
    "angular_velocity": "rotation",
    "one_way": "contact",
}
"""For each field of a body, the effect without which it has no meaning."""

_DEGREES = re.compile(r"\s*(-?[\d.]+)\s*\*\s*deg\s*")


def set_field(text: str, path: Path, typed: str) -> str:
    """Return a level with a field set to a typed text; an empty text removes the field.

    A parameter that only this field used is removed. If a field has a meaning only with an effect,
    such as a body's friction, that effect is declared. A body that is made dynamic gets a mass; one
    that is made static or kinematic loses it.

    A number is kept as it was typed; a list, an object, true and false are typed as in JSON; any
    other text is a formula, or a word where the field takes words. The text may have mistakes
    elsewhere. Raises `LevelError` if the result has a new mistake; the messages are the loader's.
    """
    before = _mistakes(text)
    changed = [type_in(put(text, path, None), path, token) for token in _readings(typed.strip())]
    if not typed.strip():
        changed = [_without(text, path)]
    if path[0] == "bodies" and path[2:] == ("type",) and not before:
        changed += [_of_type(changed[0], path, text)]
    found = [_without_what_is_unused(one, _mistakes(one)) for one in changed]
    old_mistakes = {(mistake.path, mistake.rule) for mistake in before}
    for one, mistakes in found:
        if all((mistake.path, mistake.rule) in old_mistakes for mistake in mistakes):
            return one
    if typed.strip() and not before and (meant := _with_effect(text, path)) != text:
        return set_field(meant, path, typed)
    place = shown(path)
    mistakes = found[0][1]
    raise LevelError(tuple(m for m in mistakes if m.path.startswith(place)) or mistakes)


def make_parameter(text: str, path: Path, name: str) -> str:
    """Return a level in which a number, given or left out, is a parameter, and its field a formula.

    The range of the parameter is from a fifth of the number to five times it, or less where the
    level would be invalid. For a negative number, the formula is minus the parameter; an angle in
    degrees stays in degrees. Raises `SandboxError` if there is no number, it cannot be a formula,
    or the name is taken.
    """
    text = _with_effect(text, path)
    level = parse(text)
    numbers = dict(expressions(level))
    expression = numbers.get(path)
    if expression is None or expression.names:
        message = Message("{field} cannot be a formula", field=shown(path))
        if expression:
            message = Message("{field} is already a formula", field=shown(path))
        raise SandboxError(message)
    if name in level.parameters:
        raise SandboxError("there is already a parameter '{name}'; choose another name", name=name)
    text = _stated(text, path, numbers)
    value, formula, unit = _parameter(value_at(text, path), expression, name)
    about = {"unit": unit} if unit else {}
    ranges = _ranges(value, in_degrees=unit == "deg", share=isinstance(expression, Fraction))
    changes: list[dict[str, Json]] = [
        {"value": value, "min": plain(low), "max": plain(high), **about, "label": _label(path)}
        for low, high in ranges
    ]
    return accepted(*(put_all(text, {path: formula, ("parameters", name): one}) for one in changes))


def _of_type(changed: str, path: Path, before: str) -> str:
    """Return a level in which a body whose type has changed has the fields of its new type only."""
    body = (*path[:2], "mass")
    if value_at(changed, path) == "dynamic":
        area = placed(parse(before))[str(path[1])].area
        changed = put(changed, body, plain(DENSITY * area or 1.0))
    return without_meaning(changed)


def _stated(text: str, path: Path, numbers: Mapping[Path, Expression]) -> str:
    """Return a level that states a number left out so far; of a point, both coordinates."""
    with suppress(PatchError):
        value_at(text, path)
        return text
    if isinstance(path[-1], int):
        return put(text, path[:-1], [numbers[*path[:-1], half].source for half in (0, 1)])
    angle = numbers[path].unit == "rad" and numbers[path].source == 0
    return put(text, path, "0*deg" if angle else numbers[path].source)


def _with_effect(text: str, path: Path) -> str:
    """Return a level that declares the effect which a field of a body needs, if it lacks one."""
    effect = _MEANT_BY.get(str(path[2])) if path[0] == "bodies" and len(path) == 3 else None
    with suppress(SandboxError):
        if effect and effect not in (level := parse(text)).effects.declared:
            return declare(text, level, effect)
    return text


def parameter_name(level: Level, path: Path) -> str:
    """Return a name for the parameter that replaces a number, from its field and its body."""
    words = [str(step) for step in path if isinstance(step, str)]
    names = [words[-1], "_".join(words[-2:]), "_".join((words[-1], *words[1:2]))]
    numbered = (f"{words[-1]}{number}" for number in range(2, 1000))
    taken = set(level.parameters)
    return next(name[:31] for name in (*names, *numbered) if name[:31] not in taken)


def _readings(typed: str) -> list[str]:
    """Return the JSON values that a typed text can mean, the likeliest first."""
    word = json.dumps(typed, ensure_ascii=False)
    words = json.dumps([one.strip() for one in typed.split(",")], ensure_ascii=False)
    if _NUMBER.fullmatch(typed):
        return [typed, word]
    with suppress(ValueError):
        if isfinite(float(typed)) and "_" not in typed:
            return [json.dumps(plain(float(typed))), word]
    if typed[:1] in ("[", "{") or typed in ("true", "false"):
        with suppress(ValueError):
            json.loads(typed)
            return [typed, word]
    return [word, words]


def _without(text: str, path: Path) -> str:
    with suppress(PatchError):
        return remove(text, path)
    return text


def _without_what_is_unused(
    text: str, mistakes: tuple[Mistake, ...]
) -> tuple[str, tuple[Mistake, ...]]:
    """Return a text without unused parameters and constants, and its remaining mistakes."""
    paths = [tuple(mistake.path.split(".")) for mistake in mistakes]
    if not paths or any(len(p) != 2 or p[0] not in ("parameters", "constants") for p in paths):
        return text, mistakes
    less = without_meaning(text)
    return less, _mistakes(less)


def _mistakes(text: str) -> tuple[Mistake, ...]:
    try:
        parse(text)
    except LevelError as error:
        return error.mistakes
    return ()


def _parameter(number: Json, expression: Expression, name: str) -> tuple[float, str, str]:
    """Return the value of a parameter, the formula that uses it, and its unit."""
    degrees = _DEGREES.fullmatch(number) if isinstance(number, str) else None
    value = float(degrees[1]) if degrees else expression({})
    formula = f"{name}*deg" if degrees else name
    if value < 0:
        formula = f"-{formula}"
    return plain(abs(value)), formula, "deg" if degrees else expression.unit


def _ranges(value: float, *, in_degrees: bool, share: bool) -> Iterator[tuple[float, float]]:
    """Yield ranges of a parameter, the widest first."""
    if share:
        yield 0, 1
    if in_degrees and value <= 90:
        yield 0, 90
    if not value:
        yield -10, 10
        yield 0, 1
    else:
        for factor in (5, 2, 1.2):
            yield _round(value / factor), max(_round(value * factor), value)
    yield value, value


def _round(value: float) -> float:
    """Return a number rounded down to two significant digits."""
    unit = 10.0 ** (floor(log10(value)) - 1)
    return plain(floor(value / unit + 1e-9) * unit)


def _label(path: Path) -> str:
    """Return a short label for a number."""
    words = [str(step).replace("_", " ") for step in path if isinstance(step, str)]
    owner = f" of {words[1]}" if path[0] in ("bodies", "joints") else ""
    component = f", {'xy'[path[-1]]}" if path[-1] in (0, 1) and path[0] != "checks" else ""
    field = next(word for word in reversed(words))
    return f"{field}{component}{owner}"
