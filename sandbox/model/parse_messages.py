"""The messages of the JSON reader and of pydantic, in the words of the level format."""

import re
from collections.abc import Callable, Mapping
from math import isnan
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic_core import ErrorDetails

from sandbox.model.did_you_mean import meant, suggestion
from sandbox.model.effects import Effects
from sandbox.model.errors import brief
from sandbox.model.joints import ENDS
from sandbox.model.json_positions import Path, Position
from sandbox.model.level import Level

_SYNTAX: Mapping[str, str] = {
    "Expecting property name enclosed in double quotes": (
        "a name in double quotes must stand here, or the comma before it is one too many"
    ),
    "Expecting value": "a value must stand here; text needs double quotes around it",
    "Expecting ',' delimiter": "a comma or a closing bracket is missing before this",
    "Expecting ':' delimiter": "a colon is missing before this",
    "Extra data": "the level has ended before this; there is a bracket too many",
    "Unterminated string starting at": "the double quotes that end this text are missing",
    "Invalid control character at": "a text must not run over the end of a line",
    "Illegal trailing comma before end of object": "this comma is one too many",
    "Illegal trailing comma before end of array": "this comma is one too many",
}

_TYPES: Mapping[str, str] = {
    "dict_type": "must be an object, {{...}}",
    "finite_number": "must be a finite number",
    "float_type": "must be a number",
    "greater_than": "must be greater than {gt:g}",
    "greater_than_equal": "must be at least {ge:g}",
    "int_from_float": "must be a whole number",
    "int_type": "must be a whole number",
    "less_than": "must be less than {lt:g}",
    "less_than_equal": "must be at most {le:g}",
    "literal_error": "must be {expected}",
    "mapping_type": "must be an object, {{...}}",
    "model_attributes_type": "must be an object, {{...}}",
    "model_type": "must be an object, {{...}}",
    "string_pattern_mismatch": "must be a colour such as #4cc9f0",
    "string_too_long": "must not be longer than {max_length} characters",
    "string_too_short": "must not be empty",
    "string_type": "must be a text in double quotes",
    "too_long": "has {actual_length} entries, but may have at most {max_length}",
    "too_short": "has {actual_length} entries, but needs at least {min_length}",
    "tuple_type": "must be a list, [...]",
}


def syntax(message: str) -> str:
    """Say an error of the JSON reader."""
    return f"is not JSON: {_SYNTAX.get(message, message)}"


def refused(message: str) -> tuple[str, Position | None]:
    """Say an error of pydantic's own JSON reader, and where it is."""
    what, _, place = message.rpartition(" at line ")
    found = [int(number) for number in re.findall(r"\d+", place)]
    rule = "is nested too deeply" if "recursion" in message else f"is not JSON: {what or message}"
    return rule, (found[0], found[1]) if len(found) == 2 else None


def path_of(detail: ErrorDetails, known: Callable[[Path], bool]) -> Path:
    """Drop from pydantic's location what is not in the file, such as the chosen type of a shape.

    Parameters
    ----------
    detail
        The error.
    known
        Whether a value stands at a path in the file.
    """
    path: Path = ()
    for step in detail["loc"]:
        if known((*path, step)):
            path = (*path, step)
    step = detail["loc"][-1] if detail["loc"] else 0
    return (*path, step) if detail["type"] == "missing" and isinstance(step, str) else path


def _typical(kind: str, detail: ErrorDetails) -> str:
    """Say an error that needs but a few words."""
    context = detail.get("ctx", {})
    if isinstance(given := detail["input"], float) and isnan(given):
        return "must be a number"
    if kind == "too_long" and context["actual_length"] is None:  # pydantic stopped counting
        return f"has more than {context['max_length']:,} entries; that is the most"
    return _TYPES[kind].format(**context)


def rule(detail: ErrorDetails) -> str:
    """Say an error of pydantic."""
    last = detail["loc"][-1] if detail["loc"] else ""
    match detail["type"]:
        case _ if last == "[key]":
            name = brief(str(detail["input"]))
            return f"'{name}' is not a name: a letter, then letters, digits or _"
        case "extra_forbidden":
            return _unknown(str(last), detail["loc"])
        case "missing" if isinstance(last, int):
            return "is a list with too few entries"
        case "missing":
            return f"'{last}' is missing"
        case "union_tag_invalid" | "union_tag_not_found" | "literal_error":
            return _choice(detail)
        case kind if kind in _TYPES:
            return _typical(kind, detail)
    message = detail["msg"]
    return message[0].lower() + message[1:]


def _choice(detail: ErrorDetails) -> str:
    """Say that something is none of what there is to choose from."""
    context = detail["ctx"]
    if detail["type"] == "union_tag_not_found":
        if "_end_kind" in context["discriminator"]:
            return 'must be a body\'s name, a point of one {"body": ..., "at": [x, y]}, or [x, y]'
        key = "'type'" if "type" in context["discriminator"] else "'event'"
        return f"needs the key {key}, which says what it is"
    choices = re.findall(r"'([^']+)'", str(context.get("expected_tags") or context["expected"]))
    if detail["type"] == "union_tag_invalid":
        tag = context["tag"]
        return f"unknown type '{brief(tag)}'{suggestion(tag, choices)}"
    hint = meant(detail["input"], choices) if isinstance(detail["input"], str) else ""
    return f"must be {context['expected']}{hint}"


def _unknown(name: str, loc: tuple[int | str, ...]) -> str:
    """Name an unknown key, and the key of the same place that was probably meant."""
    part: Any = Level
    for step in loc[:-1]:
        part = _inside(part, step)
    models = (getattr(choice, "model_fields", {}) for choice in _alternatives(part))
    known = [field.alias or key for fields in models for key, field in fields.items()]
    what = "effect" if loc[:-1] == ("effects",) else "key"
    hint = _owners(name, loc) or (suggestion(name, known, most=20) if known else "")
    return f"unknown {what} '{brief(name)}'{hint}"


def _owners(name: str, loc: tuple[int | str, ...]) -> str:
    """Tell to which other effects a setting belongs that one of them does not have."""
    if len(loc) < 3 or loc[0] != "effects":
        return ""
    owners = [
        f"'{effect}'"
        for effect, field in Effects.model_fields.items()
        for choice in _alternatives(field.annotation)
        for model in (choice, *get_args(choice))
        if name in getattr(model, "model_fields", {})
    ]
    return f"; it is a setting of {', '.join(owners)}" if owners else ""


def _inside(part: Any, step: str | int) -> Any:  # noqa: ANN401 (a type is any object)
    """Return the type one step further into the format, for a step of pydantic's location."""
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
