"""A level as the text of a file, laid out as people write it by hand.

Only spaces, line breaks and the order of the top-level keys are changed. Numbers, formulas and
texts stay as typed, so that the level is the same afterwards, to the last bit.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Any

from sandbox.model.comments import SIGN
from sandbox.model.json_positions import TOKEN
from sandbox.model.level import Level
from sandbox.model.shorthand.repeated_members import GROUPS, order

WIDTH = 100
"""The line width; a part whose members have a line each stays on one line if that fits."""

_INDENT = "  "
ORDER = order(known.alias or name for name, known in Level.model_fields.items())
"""The order of the top-level keys of a level."""

NAMED = ("parameters", "constants", GROUPS, "bodies", "joints", "checks", "ghosts")
"""The parts with any number of members, each of which may have a line of its own."""


@dataclass(slots=True)
class _Part:
    """A value of a JSON text as typed, with its line breaks."""

    key: str
    """The key as typed, with its quotes; empty if there is none."""
    text: str
    """The value; of an object or a list only the opening bracket."""
    broken: bool
    """Whether a line begins with it."""
    members: list["_Part"] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Its key without quotes."""
        return json.loads(self.key) if self.key else ""

    @property
    def spread(self) -> bool:
        """Whether there are line breaks between its brackets."""
        return any(member.broken for member in self.members)

    @property
    def a_line_each(self) -> bool:
        """Whether none of its members share a line, as in files by programs, and some by people."""
        return self.spread and all(member.broken for member in self.members[1:])

    @property
    def head(self) -> str:
        """The text before its members."""
        return f"{self.key}: {self.text}" if self.key else self.text

    @property
    def tail(self) -> str:
        """The text after its members."""
        return {"{": "}", "[": "]"}.get(self.text, "")

    @property
    def line(self) -> str:
        """The whole part on one line."""
        return self.head + ", ".join(member.line for member in self.members) + self.tail


def text(document: Mapping[str, Any]) -> str:
    """Return a level made by a program as JSON, with a line per parameter, body, joint or check."""
    return formatted(json.dumps(document, ensure_ascii=False))


def formatted(typed: str) -> str:
    """Return the text of a well-formed level in its layout; a text that has it stays as it is."""
    proper = _written(_read(typed))
    return proper.replace("\n", "\r\n") if "\r\n" in typed else proper


def with_schema(typed: str, schema_path: str) -> str:
    """Return the JSON text of a level that names the place of its schema, in its layout."""
    level = _read(typed)
    rest = [member for member in level.members if member.name != "$schema"]
    named = _Part('"$schema"', json.dumps(schema_path, ensure_ascii=False), broken=False)
    level.members = [named, *rest]
    return _written(level)


def _read(typed: str) -> _Part:
    """Return a whole text as a part with its members."""
    whole = _Part("", "", broken=False)
    opened, key, broken, end = [whole], "", False, 0
    for match in TOKEN.finditer(typed):
        token, inside = match[0], opened[-1]
        if not key:  # a value belongs to its key, on any line
            broken = "\n" in typed[end : match.start()]
        end = match.end()
        if token in "}]":
            opened.pop()
        elif inside.text == "{" and not key:
            key = token
            continue
        else:
            part = _Part(key, token, broken)
            inside.members.append(part)
            if token in "{[":
                opened.append(part)
        key = ""
    return whole.members[0]


def _in_order(members: list[_Part]) -> list[_Part]:
    """Return the top-level members in their order; a comment stays before what follows it."""
    rank, placed = len(ORDER), list[tuple[int, _Part]]()
    for part in reversed(members):
        rank = rank if part.name.startswith(SIGN) else ORDER.index(part.name)
        placed.append((rank, part))
    placed.reverse()
    placed.sort(key=itemgetter(0))
    return [part for _, part in placed]


def _written(level: _Part) -> str:
    """Return the text of a whole level."""
    chosen = level.spread
    level.members = _in_order(level.members)
    for part in level.members:
        part.broken = True
        if part.name in NAMED and not chosen:  # no line breaks were typed
            for member in part.members:
                member.broken = True
    return _text_of(level, 0) + "\n"


def _text_of(part: _Part, depth: int) -> str:
    """Return the text of a part, indented to a depth after its first line."""
    if _is_short(part, depth):
        return part.line
    if not part.spread:
        return part.head + ", ".join(_text_of(member, depth) for member in part.members) + part.tail
    line, inside = "\n" + _INDENT * depth, "\n" + _INDENT * (depth + 1)
    text = part.head
    for i, member in enumerate(part.members):
        text += "," * bool(i) + (inside if member.broken or not i else " ")
        text += _text_of(member, depth + 1)
    return text + line + part.tail


def _is_short(part: _Part, depth: int) -> bool:
    """Whether a part with a line per member is short enough for one line."""
    if not part.a_line_each or depth == 0 or (depth == 1 and part.name in NAMED):
        return False
    return len(_INDENT) * depth + len(part.line) + len(",") <= WIDTH
