"""Loading a level from a file: complete and frozen, or a `LevelError` with every mistake."""

import codecs
import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import reduce
from math import isfinite
from operator import getitem
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from pydantic import ValidationError
from pydantic_core import ErrorDetails

from sandbox.garbage_collection_pause import uncollected
from sandbox.model import parser_error_messages
from sandbox.model.comments import without_comments
from sandbox.model.did_you_mean import did_you_mean
from sandbox.model.errors import MAX_MISTAKES, LevelError, Mistake, ValueRangeError, brief
from sandbox.model.expression_compiler import MAX_LENGTH
from sandbox.model.expressions import Values
from sandbox.model.file_reading import UnreadableError, read_named
from sandbox.model.json_document import Document, refuse
from sandbox.model.json_positions import Origin, position
from sandbox.model.json_positions import Path as Place
from sandbox.model.level import Level, Parameter
from sandbox.model.level_parts import Fault
from sandbox.model.rules import level_validation
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.consistency import dangling
from sandbox.model.shorthand import write_out
from sandbox.model.translatable_message import NOTHING, Message, joined

MAX_BYTES = 5_000_000
"""The largest file that is read [bytes]: enough for the most bodies, of some 200 bytes each."""

LONGEST_NAME = 31

MAX_FORMULAS = 300_000
"""The most characters in all different formulas together: parsing these takes two seconds."""

MOST_VALUES = 300_000
"""The most values in a level, about: the most bodies have some 13 each, which take two seconds."""

MANY = 10 * MAX_MISTAKES
"""The most of pydantic's errors that are looked at: among them are enough to be listed."""

_MENDED = ("expression", "float_type", "int_type", "missing", "greater_than", "finite_number")
"""The types of pydantic's errors that replacing the value by 1 usually mends."""


def load(path: Path) -> Level:
    """Read a level from a JSON file; raise `LevelError` if it cannot be read, or has mistakes."""
    return parse(read(path), str(path))


def read(path: Path, largest: int = MAX_BYTES) -> str:
    """Return the text of a file; raise `LevelError` if it is unreadable, too large, or not text."""
    return decoded(content(path, largest), str(path))


def content(path: Path, largest: int = MAX_BYTES) -> bytes:
    """Return the bytes of a file; raise `LevelError` if it is unreadable or too large."""
    try:
        return read_named(path, largest)
    except UnreadableError as error:
        source = str(path)
        refuse(source, error.message)


def decoded(held: bytes, source: str) -> str:
    """Return a file's text, without a byte order mark; raise `LevelError` if it is not text."""
    content = held.removeprefix(codecs.BOM_UTF8)
    try:
        return content.decode()
    except UnicodeDecodeError as error:
        before = content[: error.start].decode()
        rule = Message(
            "is not UTF-8 text: this byte is not part of a character; save the file as UTF-8"
        )
        refuse(source, rule, position=position(before, len(before)))


def parse(text: str, source: str = "<text>") -> Level:
    """Make a level from the JSON text of a source; raise `LevelError` if it has mistakes."""
    try:
        # What is not finite is reported by name; collecting takes a third of a large level's time.
        with np.errstate(all="ignore"), uncollected():
            return _parsed(text, source)
    except LevelError:
        raise
    except Exception as error:  # a defect, which is reported to the user as well
        what = " ".join(f"{error}".split()) or Message("no details are known")
        rule = Message(
            "nothing can be computed with its numbers ({name}: {what})",
            name=type(error).__name__,
            what=what,
        )
        raise LevelError((Mistake(source, None, None, "", rule),)) from error


def _parsed(text: str, source: str) -> Level:
    _limit_values(text, source)
    document = Document(text, source)
    typed = document.read()
    try:
        data, *_ = made = write_out(typed, text)
    except RecursionError:
        document.refuse_depth()
    if made.faults:
        document.refuse(made.faults)
    document.typed = made.path_in_text
    if (length := _formulas_length(data)) > MAX_FORMULAS:
        refuse(
            source,
            "has formulas of {length:,} characters in all; at most {most:,} are allowed",
            length=length,
            most=MAX_FORMULAS,
        )
    whole = without_comments(text) if data is typed else json.dumps(data)
    _limit_values(whole, source)
    try:
        level = Level.model_validate_json(whole)
    except ValidationError as error:
        details = error.errors(include_url=False)[:MANY]
        if details[0]["type"] == "json_invalid":  # the two JSON parsers differ in details
            _refuse_json(document, details[0]["ctx"]["error"], typed=whole is text)
        document.refuse(_faults(document, data, details))
    if found := level_validation.faults(level):
        document.refuse(made.hinted(fault, typed) for fault in found)
    level.read_from(Origin(text, source, made.path_in_text))
    return level


def _limit_values(text: str, source: str) -> None:
    """Refuse a text with too many values: each comes after a comma or in a bracket of its own."""
    if text.count(",") + text.count("{") + text.count("[") > MOST_VALUES:
        refuse(source, "has more than {most:,} values, the most allowed", most=MOST_VALUES)


def _formulas_length(data: object) -> int:
    """Return the total length of all different formulas that are too long to be names."""
    found, pending = set[str](), [data]
    while pending:
        part = pending.pop()
        if isinstance(part, str):
            if LONGEST_NAME < len(part) <= MAX_LENGTH:  # longer ones are not parsed
                found.add(part)
        elif isinstance(part, dict):
            pending += part.values()
        elif isinstance(part, list):
            pending += part
    return sum(map(len, found))


def digest(level: Level) -> str:
    """Return a hash of a level's content, whatever its layout."""
    data = level.model_dump(mode="json", exclude={"schema_"})
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()[:16]


def choose(
    level: Level, settings: Mapping[str, float], among: Iterable[Condition] | None = None
) -> Values:
    """Return the values of a level's parameters, with some of them changed from their defaults.

    `among` is the result of `level_validation.depending` for the level, if already known. Raises
    `ValueRangeError` if the level has no such parameter, or a value is not finite, is out of the
    parameter's range, or makes a part of the level impossible.
    """
    for name, value in settings.items():
        if wrong := _wrong_value(level, name, value):
            raise ValueRangeError(wrong)
    values = {**level.defaults, **settings}
    held = level_validation.depending(level) if among is None and settings else among or ()
    if fault := next(level_validation.broken(held, values), None):
        chosen = ", ".join(f"{name} = {value:g}" for name, value in settings.items())
        place = ".".join(map(str, fault.path))
        raise ValueRangeError(
            "{chosen} is not possible: {place}: {rule}", chosen=chosen, place=place, rule=fault.rule
        )
    return values


def _wrong_value(level: Level, name: str, value: float) -> Message | None:
    """Say why a parameter cannot have a value by itself; None if it can."""
    if name not in level.parameters:
        known = joined((_described(*item) for item in level.parameters.items()), "; ")
        return Message(
            "unknown parameter '{name}'{hint} (there are: {known})",
            name=brief(name),
            hint=did_you_mean(name, level.parameters),
            known=known or Message("none"),
        )
    if not isfinite(value):
        return Message("'{name}' is {value}, not a finite number", name=name, value=value)
    parameter = level.parameters[name]
    if not parameter.min <= value <= parameter.max:
        return Message(
            "'{name}' is {value:g}, but must lie {range}",
            name=name,
            value=value,
            range=_range(parameter),
        )
    return None


def _described(name: str, parameter: Parameter) -> Message:
    label = Message(", the {label},", label=parameter.label) if parameter.label else NOTHING
    return Message("{name}{label} {range}", name=name, label=label, range=_range(parameter))


def _range(parameter: Parameter) -> Message:
    unit = f" {parameter.unit}" if parameter.unit else ""
    return Message(
        "between {least:g} and {most:g}{unit}", least=parameter.min, most=parameter.max, unit=unit
    )


def _refuse_json(document: Document, what: str, *, typed: bool) -> NoReturn:
    """Raise pydantic's JSON error in a text that Python's parser accepts, or in its expansion."""
    if "recursion" in what:
        document.refuse_depth()
    rule, place = parser_error_messages.refused(what)
    refuse(document.source, rule, position=place if typed else None)


def _faults(document: Document, data: Any, details: list[ErrorDetails]) -> Iterator[Fault]:  # noqa: ANN401 (whatever JSON holds)
    """Yield pydantic's errors with their paths, and further mistakes found in spite of them."""
    paths = [parser_error_messages.path_of(detail, document.has) for detail in details]
    placed = [
        (path, detail)
        for path, detail in zip(paths, details, strict=True)
        if detail["type"] != "too_short" or not _holds_another(path, paths)
    ]
    ordered = sorted(placed, key=lambda pair: document.start(pair[0]))
    for path, detail in ordered[: MAX_MISTAKES + 1]:
        yield Fault(path, parser_error_messages.rule(detail))
    mended = _mend(document, data, details) if len(details) < MANY else None
    if mended is not None:
        yield from dangling(mended)


def _holds_another(path: Place, paths: Sequence[Place]) -> bool:
    """Whether another path is inside a list, which pydantic counts without its invalid members."""
    return any(len(other) > len(path) and other[: len(path)] == path for other in paths)


def _mend(document: Document, data: Any, details: list[ErrorDetails]) -> Level | None:  # noqa: ANN401 (whatever JSON holds)
    """Return the level without the values that pydantic refused, if that is possible.

    It only serves to find names that refer to nothing, so that they are reported at the same time.
    """
    try:
        for detail in details:
            *outside, last = parser_error_messages.path_of(detail, document.has)
            part = reduce(getitem, outside, data)
            if detail["type"] == "extra_forbidden":
                del part[last]
            elif detail["type"] in _MENDED:
                part[last] = 1
        return Level.model_validate_json(json.dumps({**data, "format": 1, "title": "?"}))
    except (ValidationError, LookupError, TypeError, ValueError, RecursionError):
        return None
