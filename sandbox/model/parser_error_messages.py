"""The errors of the JSON parser and of pydantic, in the words of the level format."""

import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from json import JSONDecodeError
from math import isnan
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic_core import ErrorDetails

from sandbox.model.did_you_mean import closest, did_you_mean, suggestion
from sandbox.model.effects import EFFECTS, Effects
from sandbox.model.errors import brief
from sandbox.model.joints import ENDS, KINDS
from sandbox.model.json_positions import Path, Position
from sandbox.model.level import Level
from sandbox.model.shorthand.repeated_members import GROUPS
from sandbox.model.translatable_message import NOTHING, Message, either

_SYNTAX: Mapping[str, Message] = {
    "Expecting property name enclosed in double quotes": Message(
        "a name in double quotes must follow here, or else remove the comma before it"
    ),
    "Expecting value": Message("a value is missing here; text needs double quotes around it"),
    "Expecting ',' delimiter": Message("a comma or a closing bracket is missing before this"),
    "Expecting ':' delimiter": Message("a colon is missing before this"),
    "Extra data": Message("the level ends before this; there is one bracket too many"),
    "Unterminated string starting at": Message("the double quotes that end this text are missing"),
    "Unexpected UTF-8 BOM (decode using utf-8-sig)": Message(
        "the byte order mark at the beginning of the file must be removed"
    ),
    "Illegal trailing comma before end of object": Message("this comma is one too many"),
    "Illegal trailing comma before end of array": Message("this comma is one too many"),
    "Invalid \\escape": Message("a backslash in a text is written \\\\"),
    "Invalid \\uXXXX escape": Message("\\u must be followed by four hexadecimal digits"),
}

_SLIPS = (
    (re.compile(""), re.compile("//|/\\*|#"), Message('comments are keys: "//": "..."')),
    (re.compile(""), re.compile("'"), Message("text needs double quotes, not single ones")),
    (
        re.compile(""),
        re.compile(r"[+.]"),
        Message("a number begins with a digit, or with - and a digit"),
    ),
    (re.compile(r"\d,$"), re.compile(r"\d"), Message("a decimal point is written ., not a comma")),
)
"""What often stands before and behind an error of JSON's syntax, and what to write instead."""
_LINE_END = Message("a text must not run over the end of a line")
_CONTROL = Message("the control character {code} must be removed")

_OBJECT = Message("must be an object, {...}")

_TYPES: Mapping[str, Message] = {
    "bool_type": Message("must be true or false"),
    "dict_type": _OBJECT,
    "finite_number": Message("must be a finite number"),
    "float_type": Message("must be a number"),
    "int_from_float": Message("must be a whole number"),
    "int_parsing_size": Message("is too large a number"),
    "int_type": Message("must be a whole number"),
    "mapping_type": _OBJECT,
    "model_attributes_type": _OBJECT,
    "model_type": _OBJECT,
    "string_pattern_mismatch": Message("must be a colour such as #4cc9f0"),
    "string_too_short": Message("must not be empty"),
    "string_type": Message("must be a text in double quotes"),
    "tuple_type": Message("must be a list, [...]"),
}

_WHOLE = (_OBJECT, _TYPES["tuple_type"])
"""The messages that the form of the part takes the place of, if it is known."""

_BOUNDS: Mapping[str, Message] = {
    "greater_than": Message("must be greater than {gt:g}"),
    "greater_than_equal": Message("must be at least {ge:g}"),
    "less_than": Message("must be less than {lt:g}"),
    "less_than_equal": Message("must be at most {le:g}"),
    "string_too_long": Message("must not be longer than {max_length} characters"),
    "too_long": Message("has {actual_length} entries, but may have at most {max_length}"),
    "too_short": Message("has {actual_length} entries, but needs at least {min_length}"),
}
"""Messages for pydantic's bounds, with placeholders for the values."""


def syntax(error: JSONDecodeError) -> Message:
    """Return the message for an error of the JSON parser."""
    before, behind = error.doc[: error.pos], error.doc[error.pos :]
    slips = (slip for first, then, slip in _SLIPS if first.search(before) and then.match(behind))
    reason = next(slips, _SYNTAX.get(error.msg, error.msg))
    found = behind[:1]
    if found in ("\r", "\n") and error.msg.startswith("Invalid control"):
        reason = _LINE_END
    elif found and unicodedata.category(found) == "Cc":
        reason = _CONTROL.filled(code=f"U+{ord(found):04X}")
    return Message("is not JSON: {reason}", reason=reason)


def refused(message: str) -> tuple[Message, Position | None]:
    """Return the message for an error of pydantic's own JSON parser, and its position."""
    what, _, place = message.rpartition(" at line ")
    found = [int(number) for number in re.findall(r"\d+", place)]
    rule = Message("is not JSON: {reason}", reason=what or message)
    return rule, (found[0], found[1]) if len(found) == 2 else None


def path_of(detail: ErrorDetails, known: Callable[[Path], bool]) -> Path:
    """Drop steps of pydantic's location that are not in the file, such as the type of a shape.

    `known` tells whether the file has a value at a path.
    """
    path: Path = ()
    for step in detail["loc"]:
        if known((*path, step)):
            path = (*path, step)
    step = detail["loc"][-1] if detail["loc"] else 0
    return (*path, step) if detail["type"] == "missing" and isinstance(step, str) else path


def _typical(kind: str, detail: ErrorDetails) -> Message:
    """Return the message for an error that needs only a few words."""
    context = detail.get("ctx", {})
    if isinstance(given := detail["input"], float) and isnan(given):
        return Message("must be a number")
    if kind == "too_long" and context["actual_length"] is None:  # pydantic stopped counting
        return Message(
            "has more than {most:,} entries, the most allowed", most=context["max_length"]
        )
    return _BOUNDS[kind].filled(**context) if kind in _BOUNDS else _TYPES[kind]


def rule(detail: ErrorDetails, whole: type = Level) -> Message:
    """Return the message for an error of pydantic in a level, or in another whole type."""
    last = detail["loc"][-1] if detail["loc"] else ""
    match detail["type"]:
        case _ if last == "[key]":
            name = brief(str(detail["input"]))
            return Message("'{name}' is not a name: a letter, then letters, digits or _", name=name)
        case "extra_forbidden":
            return _unknown(str(last), detail["loc"], whole)
        case "missing" if isinstance(last, int):
            return Message("is a list with too few entries")
        case "missing":
            return Message("'{last}' is missing", last=last)
        case "union_tag_invalid" | "union_tag_not_found" | "literal_error":
            return _choice(detail)
        case kind if kind in _TYPES or kind in _BOUNDS:
            return _formed(detail, whole) or _typical(kind, detail)
    reason, message = detail.get("ctx", {}).get("reason"), detail["msg"]
    if isinstance(reason, Message):
        return reason
    return Message("{reason}", reason=message[0].lower() + message[1:])


def _choice(detail: ErrorDetails) -> Message:
    """Say that a value is not among the possible ones."""
    context = detail["ctx"]
    if detail["type"] == "union_tag_not_found":
        if "_end_kind" in context["discriminator"]:
            return Message(
                'must be a body\'s name, a point of one {"body": ..., "at": [x, y]}, or [x, y]'
            )
        key = "'type'" if "type" in context["discriminator"] else "'event'"
        return Message("needs the key {key}, which says what it is", key=key)
    choices = re.findall(r"'([^']+)'", str(context.get("expected_tags") or context["expected"]))
    if detail["type"] == "union_tag_invalid":
        tag = context["tag"]
        return Message("unknown type '{tag}'{hint}", tag=brief(tag), hint=suggestion(tag, choices))
    hint = did_you_mean(detail["input"], choices) if isinstance(detail["input"], str) else NOTHING
    return Message("must be {choices}{hint}", choices=_listed(context["expected"]), hint=hint)


def _listed(expected: str) -> Message:
    """Return pydantic's list of choices, as: a, b or c."""
    some, _, last = expected.rpartition(" or ")
    return either([some, last] if some else [last])


def _unknown(name: str, loc: tuple[int | str, ...], whole: type) -> Message:
    """Name an unknown key, and the key of the same object that was probably meant."""
    part = _type_at(loc[:-1], whole)
    models = (getattr(choice, "model_fields", {}) for choice in _alternatives(part))
    known = [field.alias or key for fields in models for key, field in fields.items()]
    if len(loc) == 1:
        known.append(GROUPS)  # written out by now
    hint = _elsewhere(name, loc, known) or (
        suggestion(name, known, longest=20) if known else NOTHING
    )
    if loc[:-1] == ("effects",):
        return Message("unknown effect '{name}'{hint}", name=brief(name), hint=hint)
    return Message("unknown key '{name}'{hint}", name=brief(name), hint=hint)


def _elsewhere(name: str, loc: tuple[int | str, ...], known: Sequence[str]) -> Message:
    """Say where the key belongs, if that is elsewhere."""
    if loc[:-1] == ("effects",):
        joint = name if name in KINDS else closest(name, KINDS)
        if joint and closest(name, known) is None:
            return Message("; '{joint}' is a joint, declared under 'joints'", joint=joint)
    if loc[0] == "effects" and len(loc) == 3:
        effect = EFFECTS.get(str(loc[1]))
        if effect and effect.coefficient and closest(name, known) is None:
            return Message("; the coefficient belongs to each body, as its '{key}'", key=loc[1])
    if loc[0] == "bodies" and name in EFFECTS:
        return Message("; it is an effect, declared under 'effects'")
    return _owners(name, loc)


def _owners(name: str, loc: tuple[int | str, ...]) -> Message:
    """Name the other effects that have a setting which this one lacks."""
    if len(loc) < 3 or loc[0] != "effects":
        return NOTHING
    owners = [
        f"'{effect}'"
        for effect, field in Effects.model_fields.items()
        for choice in _alternatives(field.annotation)
        for model in (choice, *get_args(choice))
        if name in getattr(model, "model_fields", {})
    ]
    return Message("; it is a setting of {owners}", owners=", ".join(owners)) if owners else NOTHING


def _formed(detail: ErrorDetails, whole: type) -> Message:
    """Show the form of an object or a list, if it is known."""
    kind = _TYPES.get(detail["type"])
    form = _form_at(detail["loc"], whole) if kind in _WHOLE else ""
    if not form:
        return NOTHING
    if kind == _OBJECT:
        return Message("must be an object, {form}", form=form)
    return Message("must be a list, {form}", form=form)


def _form_at(loc: tuple[int | str, ...], whole: type) -> str:
    """Return what the part at pydantic's location looks like in JSON; empty if not known."""
    form = _form(_type_at(loc, whole))
    is_effect = loc[:1] == ("effects",) and len(loc) == 2
    return form or ("{}" if is_effect else "")


def _form(part: Any) -> str:  # noqa: ANN401 (a type is any object)
    """Return what a part looks like in JSON, with its required keys; empty if that is not known."""
    choices = [choice for choice in _alternatives(part) if choice is not NoneType]
    fields = [getattr(choice, "model_fields", None) for choice in choices]
    if all(fields):
        needed = [
            {field.alias or key for key, field in one.items() if field.is_required()}
            for one in fields
            if one
        ]
        first = fields[0] or {}
        keys = [key for key in first if all(key in some for some in needed)]
        return "{" + ", ".join(f'"{key}": ...' for key in keys) + "}" if keys else ""
    if len(choices) == 1 and get_origin(choices[0]) is tuple:
        items = get_args(choices[0])
        if Ellipsis not in items:
            return f"[{', '.join('xy'[: len(items)])}]" if len(items) == 2 else ""
        inner = _form(items[0])
        return f"[{inner}]" if inner else ""
    if len(choices) == 1 and get_origin(choices[0]) is Mapping:
        return '{"name": ' + (_form(get_args(choices[0])[1]) or "...") + "}"
    return ""


def _type_at(loc: Sequence[int | str], whole: type) -> Any:  # noqa: ANN401 (a type is any object)
    """Return the type of the part at pydantic's location."""
    part: Any = whole
    for step in loc:
        part = _inside(part, step)
    return part


def _inside(part: Any, step: str | int) -> Any:  # noqa: ANN401 (a type is any object)
    """Return the type of a part one step further into the format, along pydantic's location."""
    if step in ENDS:
        return part
    for choice in _alternatives(part):
        fields = getattr(choice, "model_fields", {})
        if step in fields:
            return fields[step].annotation
        tags = [fields[key].annotation for key in ("type", "event") if key in fields]
        if any(step in get_args(tag) for tag in tags):
            return choice
        if get_origin(choice) in (Mapping, tuple):
            return [argument for argument in get_args(choice) if argument is not Ellipsis][-1]
    return None


def _alternatives(part: Any) -> list[Any]:  # noqa: ANN401 (a type is any object)
    """Return the members of a union, annotated or not; a list of one for any other type."""
    if get_origin(part) is Annotated:
        return _alternatives(get_args(part)[0])
    if get_origin(part) in (Union, UnionType):
        return [inner for member in get_args(part) for inner in _alternatives(member)]
    return [part]
