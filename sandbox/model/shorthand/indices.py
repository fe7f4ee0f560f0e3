"""The indices of repeated members: their ranges, and their values in texts such as `{i + 1}`."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, brief
from sandbox.model.expression_compiler import RESERVED, ExpressionError
from sandbox.model.expressions import Expression
from sandbox.model.json_positions import Path
from sandbox.model.shorthand.expansion_notes import Notes
from sandbox.model.translatable_message import NOTHING, Message

Indices = Mapping[str, float]

MOST_TIMES = 20_000
"""The most values of an index: as many as bodies in a level."""

_BRACES = re.compile(r"\{([^{}]*)\}")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")

HOW = Message('a count, {"i": 5} for 0 to 4, or the first and last value, {"i": [1, 5]}')


class IndexFault(SandboxError):  # noqa: N818 (a fault of the text, as others are)
    """A text in braces that is not a whole number; the message is fit to be shown."""


def filled(text: str, indices: Indices) -> str:
    """Return a text with the expressions in braces replaced by their values.

    Raises `IndexFault` if an expression in braces is not a whole number.
    """
    return _BRACES.sub(lambda found: _shown(_number(found[1], indices)), text)


def _shown(number: int) -> str:
    return f"({number})" if number < 0 else f"{number}"  # for powers: -1**2 is not (-1)**2


def _number(source: str, indices: Indices) -> int:
    if source in indices:  # the usual case
        return int(indices[source])
    quoted = f"'{{{brief(source)}}}'"
    try:
        expression = Expression(source)
        if unknown := expression.names - indices.keys():
            name = min(unknown)
            hint = suggestion(name, indices)
            raise IndexFault(
                Message(
                    "{said} may use only indices, and '{name}' is not one{hint}",
                    said=quoted,
                    name=name,
                    hint=hint,
                )
            )
        value = expression(indices)
    except ExpressionError as error:
        raise IndexFault(Message("{said}: {error}", said=quoted, error=error.message)) from None
    if not value.is_integer():
        raise IndexFault(
            Message("{said} is {value:g}, not a whole number", said=quoted, value=value)
        )
    return int(value)


def runs(repeat: Any, path: Path, indices: Indices, notes: Notes) -> Iterator[Indices]:  # noqa: ANN401 (whatever JSON holds)
    """Yield the indices of every copy, the last index varying fastest.

    The value of `repeat` is the range of each index, which may depend on earlier ones. The notes
    receive mistakes; after one, nothing more is yielded.
    """
    if not isinstance(repeat, dict) or not repeat:
        notes.refuse(path, Message("must name an index and its range: {how}", how=HOW))
        return
    yield from _nested(list(repeat.items()), path, indices, notes)


def _nested(
    left: list[tuple[str, Any]], path: Path, indices: Indices, notes: Notes
) -> Iterator[Indices]:
    if not left:
        yield indices
        return
    (name, bounds), *rest = left
    path_of_index = (*path, name)
    if rule := _misnamed(name, indices):
        notes.refuse(path_of_index, rule)
        return
    try:
        first, last = _bounds(bounds, indices)
    except IndexFault as fault:
        notes.refuse(path_of_index, fault.message)
        return
    for index in range(first, last + 1):
        notes.charge(0, path)
        before = len(notes.faults)
        yield from _nested(rest, path, {**indices, name: index}, notes)
        if len(notes.faults) > before:
            return  # the other copies have the same mistake


def _misnamed(name: str, indices: Indices) -> Message:
    if not _NAME.fullmatch(name):
        return Message(
            "'{name}' is not a name: a letter, then letters, digits or _", name=brief(name)
        )
    if name in RESERVED:
        return Message("'{name}' already has a meaning in formulas; choose another name", name=name)
    if name in indices:
        return Message("the index '{name}' is already used around this", name=name)
    return NOTHING


def _bounds(bounds: Any, indices: Indices) -> tuple[int, int]:  # noqa: ANN401 (whatever JSON holds)
    """Return the first and the last value of an index."""
    if isinstance(bounds, list) and len(bounds) == 2:
        first, last = (_whole_number(bound, indices) for bound in bounds)
    else:
        first, last = 0, _whole_number(bounds, indices) - 1
    if max(abs(first), abs(last)) > 2 * MOST_TIMES or last - first >= MOST_TIMES:
        raise IndexFault(Message("counts too far, beyond {most:,}", most=MOST_TIMES))
    if last < first - 1:
        raise IndexFault(
            Message("ends before it begins, from {first} to {last}", first=first, last=last)
        )
    return first, last


def _whole_number(value: Any, indices: Indices) -> int:  # noqa: ANN401 (whatever JSON holds)
    """Return a whole number, which may be an expression in braces."""
    if isinstance(value, str) and (braces := _BRACES.fullmatch(value.strip())):
        return _number(braces[1], indices)
    if isinstance(value, bool) or not isinstance(value, int):
        raise IndexFault(
            Message(
                "must be {how}: whole numbers, or expressions in other indices in braces", how=HOW
            )
        )
    return value
