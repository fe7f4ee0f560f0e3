"""The layout of new values in a level's text, which `format` leaves unchanged."""

import json
from collections.abc import Iterator, Mapping, Sequence

from sandbox.model.level_writing import WIDTH

Json = None | bool | int | float | str | Sequence["Json"] | Mapping[str, "Json"]
"""A JSON value."""

INDENT = "  "

DIGITS = 15
"""Significant digits of computed numbers; the digits after them are rounding."""


def plain(value: float) -> float:
    """Return a number as a person would type it: at most 15 digits, and 2 instead of 2.0."""
    short = float(f"{value:.{DIGITS}g}")
    return int(short) if short.is_integer() and abs(short) < 1e15 else short


def line(value: Json) -> str:
    """Return a value on one line."""
    return json.dumps(_plain(value), ensure_ascii=False, allow_nan=False)


def laid_out(value: Json, margin: str, before: int) -> str:
    """Return a value as laid out in a file, on one line or several.

    Its line starts with the margin, and has some characters before it, including its key.
    """
    short = line(value)
    if before + len(short) < WIDTH or not value or isinstance(value, str | int | float):
        return short
    inner = margin + INDENT
    if isinstance(value, Mapping):
        items, ends = _of_object(value, inner), "{}"
    else:
        items, ends = (laid_out(each, inner, len(inner)) for each in value), "[]"
    return f"{ends[0]}\n{inner}{_filled(list(items), inner)}\n{margin}{ends[1]}"


def _of_object(value: Mapping[str, Json], inner: str) -> Iterator[str]:
    for key, item in value.items():
        start = f"{line(key)}: "
        yield start + laid_out(item, inner, len(inner) + len(start))


def _filled(members: Sequence[str], margin: str) -> str:
    """Return members on as few lines as possible."""
    text, room = "", WIDTH - len(margin)
    for index, member in enumerate(members):
        long = len(member.partition("\n")[0]) + len(",")
        if not index:
            text, room = member, room - long
        elif long + 1 <= room and "\n" not in member:
            text, room = f"{text}, {member}", room - long - 1
        else:
            text, room = f"{text},\n{margin}{member}", WIDTH - len(margin) - long
        if "\n" in member:
            room = 0
    return text


def _plain(value: Json) -> Json:
    """Return a value with all its numbers as a person would type them."""
    if isinstance(value, float):
        return plain(value)
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(item) for item in value]
    return value
