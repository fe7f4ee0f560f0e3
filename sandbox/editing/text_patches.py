"""Patches of a level's text: one place changes, every other character stays.

Pure functions from text to text. A path is made of keys and indices, from the outside in, such as
`("bodies", "box", "mass")`. What is put stands as people lay it out, so that `format` leaves it;
a number as a person would type it; and what stands already is not typed anew.
"""

import json
import re
from collections.abc import Iterable, Mapping
from itertools import takewhile

from sandbox.editing.json_layout import INDENT, Json, laid_out, line
from sandbox.editing.json_spans import Span, Spans
from sandbox.model.document import Document
from sandbox.model.errors import SandboxError
from sandbox.model.json_positions import Path
from sandbox.model.message import Message
from sandbox.model.writing import NAMED, ORDER, WIDTH

Changes = dict[Path, Json]
"""New values, by their paths in a text."""

_LINES = tuple((part,) for part in NAMED)
"""The parts whose members each have a line: bodies, joints, checks."""


class PatchError(SandboxError):
    """A place in a text at which nothing can be put, or taken away."""


def put(text: str, path: Path, value: Json) -> str:
    """Return a text in which a value stands at a path.

    Parameters
    ----------
    text
        The JSON of a level, which may have mistakes.
    path
        Of a member or an item, there or not. A list's length, as an index, appends to it. Parents
        that are missing are made.
    value
        Anything that JSON can hold.

    Raises
    ------
    LevelError
        If the text is no JSON.
    PatchError
        If a parent is neither an object nor a list, or a list is shorter than that.
    """
    return put_all(text, {path: value})


def put_all(text: str, values: Mapping[Path, Json]) -> str:
    """Return a text in which values stand at paths, as by `put` one after the other."""
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
    """Return a text in which a value stands that is there already, as it was typed: `2.50`, say."""
    span = _at(_read(text), path)
    return text[: span.begin] + typed + text[span.end :]


def remove(text: str, path: Path) -> str:
    """Return a text without a member or an item.

    A list that is left empty goes, too, and so does an outermost part of a level; but an effect
    stays, for an empty one says that it acts, and `bodies`, which a level cannot be without.

    Raises
    ------
    LevelError
        If the text is no JSON.
    PatchError
        If nothing stands at the path.
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
    """Return what stands at a path.

    Raises
    ------
    LevelError
        If the text is no JSON.
    PatchError
        If nothing stands there.
    """
    span = _at(_read(text), path)
    return json.loads(text[span.begin : span.end])


def _read(text: str) -> Spans:
    Document(text, "<text>").read()  # refuses what is no JSON
    return Spans(text)


def _at(found: Spans, path: Path) -> Span:
    if not path or path not in found:
        raise PatchError(Message("nothing stands at {path}", path=shown(path)))
    return found[path]


def shown(path: Path) -> str:
    """Return a path as messages show it."""
    return ".".join(map(str, path)) or "the root"


def _goes_empty(parent: Span) -> bool:
    """Whether a part says nothing once it is empty."""
    if parent.kind == "list":
        return True
    return len(parent.path) == 1 and parent.path != ("bodies",)


def _instead(text: str, span: Span, value: Json) -> str:
    """Return a value as it stands in the place of another: on one line if that was.

    The same value stays as it was typed.
    """
    typed = text[span.begin : span.end]
    if json.loads(typed) == json.loads(line(value)):
        return typed
    if "\n" not in typed:
        return line(value)
    start = text.rfind("\n", 0, span.start) + 1
    return _with_breaks(text, laid_out(value, _margin(text, span.start), span.begin - start))


def spliced(text: str, pieces: Iterable[tuple[int, int, str]]) -> str:
    """Return a text with pieces of it replaced; none may lie within another."""
    changed, end = [], 0
    for begin, over, new in sorted(pieces):
        if begin < end:
            raise PatchError(Message("two values are put in one place"))
        changed += [text[end:begin], new]
        end = over
    return "".join(changed) + text[end:]


def _inserted(text: str, path: Path, value: Json) -> str:
    """Return a text with a value that is not there yet."""
    found = _read(text)
    while path[:-1] not in found or text[found[path[:-1]].begin :].startswith("null"):
        value, path = ({path[-1]: value} if isinstance(path[-1], str) else [value]), path[:-1]
    if path in found:  # null, which says that there is none
        return spliced(text, [(found[path].begin, found[path].end, line(value))])
    parent, step = found[path[:-1]], path[-1]
    if parent.kind != ("object" if isinstance(step, str) else "list"):
        raise PatchError(
            Message("{path} holds nothing of the name {step}", path=shown(parent.path), step=step)
        )
    if isinstance(step, int) and step != len(parent.members):
        raise PatchError(
            Message(
                "{path} has {count} items, so none at {step}",
                path=shown(parent.path),
                count=len(parent.members),
                step=step,
            )
        )
    return _with_member(text, parent, f"{line(step)}: " if isinstance(step, str) else "", value)


def _with_member(text: str, parent: Span, key: str, value: Json) -> str:
    """Return a text in which an object or list has one member more."""
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
    """Whether some members of an object or list stand on one line with others."""
    pairs = zip(parent.members, parent.members[1:], strict=False)
    return any("\n" not in text[one.end : other.start] for one, other in pairs)


def _in_line(text: str, parent: Span, key: str, value: Json) -> str:
    """Return a text in which an object or list that is on one line has one member more."""
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
    """Return how many members come before a new one.

    In a level the parts have their order, and a part begins with its type.
    """
    name = json.loads(key.removesuffix(": ") or "null")
    if parent.path:
        return 0 if name == "type" else len(parent.members)
    order = [*ORDER, *(str(member.path[-1]) for member in parent.members)]
    own = order.index(name)
    ahead = takewhile(lambda m: order.index(str(m.path[-1])) < own, parent.members)
    return len(list(ahead))


def _margin(text: str, index: int) -> str:
    """Return the white space that the line of a character begins with."""
    start = text.rfind("\n", 0, index) + 1
    found = re.compile(r"[ \t]*").match(text, start)
    return found[0] if found else ""


def _with_breaks(text: str, new: str) -> str:
    """Return what is put into a text with the line breaks that the text has."""
    return new.replace("\n", "\r\n") if "\r\n" in text else new
