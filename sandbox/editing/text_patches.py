"""Patches of a level's text: one value changes, every other character stays.

They are pure functions from text to text. A path consists of keys and indices, from the outside in,
such as `("bodies", "box", "mass")`. New values are laid out as `format` would, and numbers are
written as a person would type them; an equal value is left as it was typed.
"""

import json
import re
from collections.abc import Iterable, Mapping
from itertools import takewhile

from sandbox.editing.inserted_value_layout import INDENT, Json, laid_out, line
from sandbox.editing.json_spans import Span, Spans
from sandbox.model.errors import SandboxError
from sandbox.model.json_document import Document
from sandbox.model.json_positions import Path
from sandbox.model.level_writing import NAMED, ORDER, WIDTH

Changes = dict[Path, Json]
"""New values, by their paths in a text."""

_LINES = tuple((part,) for part in NAMED)
"""The paths of the parts whose members each have a line: bodies, joints, checks."""


class PatchError(SandboxError):
    """A path in a text at which nothing can be put or removed."""


def put(text: str, path: Path, value: Json) -> str:
    """Return a text, which may have mistakes, with a value at a path; missing parents are created.

    The length of a list, as an index, appends to it. Raises `LevelError` if the text is not JSON.
    Raises `PatchError` if a parent is not an object or a list, or a list is shorter than the index.
    """
    return put_all(text, {path: value})


def put_all(text: str, values: Mapping[Path, Json]) -> str:
    """Return a text with values at paths, as by repeated `put`."""
    found = _read(text)
    new = [path for path in values if path not in found]
    pieces = [
        (span.begin, span.end, _instead(text, span, values[path]))
        for path in values
        if (span := found.get(path))
    ]
    changed = spliced(text, pieces)
    for path in new:
        changed = _inserted(changed, path, values[path])
    return changed


def type_in(text: str, path: Path, typed: str) -> str:
    """Return a text in which an existing value is replaced by typed JSON, such as `2.50`."""
    span = _at(_read(text), path)
    return text[: span.begin] + typed + text[span.end :]


def remove(text: str, path: Path) -> str:
    """Return a text without a member or an item.

    A list that becomes empty is removed too, and so is a top-level part; but not an effect, which
    acts even if empty, nor `bodies`, which a level must have. Raises `LevelError` if the text is
    not JSON. Raises `PatchError` if there is nothing at the path.
    """
    found = _read(text)
    span, parent = _at(found, path), found[path[:-1]]
    while len(parent.members) == 1 and parent.path and _goes_empty(parent):
        span, parent = parent, found[parent.path[:-1]]
    index = parent.members.index(span)
    if len(parent.members) == 1:
        start, end = parent.begin + 1, parent.end - 1
    elif index:
        start, end = parent.members[index - 1].end, span.end
    else:
        start, end = span.start, parent.members[1].start
    return text[:start] + text[end:]


def value_at(text: str, path: Path) -> Json:
    """Return the value at a path; raise `PatchError` if there is none, `LevelError` if not JSON."""
    span = _at(_read(text), path)
    return json.loads(text[span.begin : span.end])


def _read(text: str) -> Spans:
    Document(text, "<text>").read()  # refuses what is not JSON
    return Spans(text)


def _at(found: Spans, path: Path) -> Span:
    if not path or path not in found:
        raise PatchError("there is nothing at {path}", path=shown(path))
    return found[path]


def shown(path: Path) -> str:
    """Return a path as messages show it."""
    return ".".join(map(str, path)) or "the root"


def _goes_empty(parent: Span) -> bool:
    """Return whether a part has no meaning once it is empty."""
    if parent.kind == "list":
        return True
    return len(parent.path) == 1 and parent.path != ("bodies",)


def _instead(text: str, span: Span, value: Json) -> str:
    """Return a value laid out to replace another: on one line if the other was.

    An equal value is left as it was typed.
    """
    typed = text[span.begin : span.end]
    if json.loads(typed) == json.loads(line(value)):
        return typed
    if "\n" not in typed:
        return line(value)
    start = text.rfind("\n", 0, span.start) + 1
    return _with_breaks(text, laid_out(value, _margin(text, span.start), span.begin - start))


def spliced(text: str, pieces: Iterable[tuple[int, int, str]]) -> str:
    """Return a text with pieces of it replaced; they must not overlap."""
    changed, end = [], 0
    for begin, over, new in sorted(pieces):
        if begin < end:
            raise PatchError("two values are put in the same place")
        changed += [text[end:begin], new]
        end = over
    return "".join(changed) + text[end:]


def _inserted(text: str, path: Path, value: Json) -> str:
    """Return a text with a value at a path where there was none."""
    found = _read(text)
    while path[:-1] not in found or text[found[path[:-1]].begin :].startswith("null"):
        value, path = ({path[-1]: value} if isinstance(path[-1], str) else [value]), path[:-1]
    if path in found:  # null, which stands for none
        return spliced(text, [(found[path].begin, found[path].end, line(value))])
    parent, step = found[path[:-1]], path[-1]
    if parent.kind != ("object" if isinstance(step, str) else "list"):
        raise PatchError("{path} has nothing named {step}", path=shown(parent.path), step=step)
    if isinstance(step, int) and step != len(parent.members):
        raise PatchError(
            "{path} has {count} items, so none at {step}",
            path=shown(parent.path),
            count=len(parent.members),
            step=step,
        )
    return _with_member(text, parent, f"{line(step)}: " if isinstance(step, str) else "", value)


def _with_member(text: str, parent: Span, key: str, value: Json) -> str:
    """Return a text in which an object or list has a new member."""
    members = parent.members
    if not members or "\n" not in text[parent.begin : members[-1].start]:
        return _in_line(text, parent, key, value)
    before = _place(parent, key)
    last = members[before - 1] if before else members[0]
    margin = _margin(text, last.start)
    new = key + laid_out(value, margin, len(margin) + len(key))
    if not before:
        return spliced(text, [(last.start, last.start, _with_breaks(text, f"{new},\n{margin}"))])
    start = text.rfind("\n", 0, last.end) + 1
    alone = parent.path == () or len(parent.path) == 1 or "\n" in new
    fits = last.end - start + len(f", {new},") <= WIDTH and not alone and _shares(text, parent)
    gap = " " if fits else f"\n{margin}"
    return spliced(text, [(last.end, last.end, _with_breaks(text, f",{gap}{new}"))])


def _shares(text: str, parent: Span) -> bool:
    """Return whether some members of an object or list share a line."""
    pairs = zip(parent.members, parent.members[1:], strict=False)
    return any("\n" not in text[one.end : other.start] for one, other in pairs)


def _in_line(text: str, parent: Span, key: str, value: Json) -> str:
    """Return a text in which an object or list on one line has a new member."""
    margin = _margin(text, parent.start)
    inside = text[parent.begin + 1 : parent.members[-1].end] if parent.members else ""
    pieces = [inside] * bool(inside)
    before = 0 if pieces and not _place(parent, key) else len(pieces)
    short = ", ".join([*pieces[:before], key + line(value), *pieces[before:]])
    start = text.rfind("\n", 0, parent.start) + 1
    named = parent.path in _LINES and not inside
    if parent.begin - start + len(f"{{{short}}},") <= WIDTH and not named:
        new = short
    else:
        inner = margin + INDENT
        new = key + laid_out(value, inner, len(inner) + len(key))
        lines = [*pieces[:before], new, *pieces[before:]]
        new = f"\n{inner}" + f",\n{inner}".join(lines) + f"\n{margin}"
    return spliced(text, [(parent.begin + 1, parent.end - 1, _with_breaks(text, new))])


def _place(parent: Span, key: str) -> int:
    """Return the number of members before a new one.

    The parts of a level have a fixed order, and a part begins with its type.
    """
    name = json.loads(key.removesuffix(": ") or "null")
    if parent.path:
        return 0 if name == "type" else len(parent.members)
    order = [*ORDER, *(str(member.path[-1]) for member in parent.members)]
    own = order.index(name)
    ahead = takewhile(lambda m: order.index(str(m.path[-1])) < own, parent.members)
    return len(list(ahead))


def _margin(text: str, index: int) -> str:
    """Return the white space at the start of the line of a character."""
    start = text.rfind("\n", 0, index) + 1
    found = re.compile(r"[ \t]*").match(text, start)
    return found[0] if found else ""


def _with_breaks(text: str, new: str) -> str:
    """Return an insertion with the kind of line breaks that the text has."""
    return new.replace("\n", "\r\n") if "\r\n" in text else new
