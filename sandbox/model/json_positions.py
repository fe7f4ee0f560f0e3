"""The position of each value in a JSON text, by which messages locate the parts of a level."""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from sandbox.model.errors import brief

Path = tuple[str | int, ...]
"""Keys and indices, from the outside in."""

Position = tuple[int, int]
"""Line and column, from 1."""

TOKEN = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"|[{}\[\]]|[^\s,:{}\[\]"]+', re.DOTALL)
"""A bracket, a quoted text, a number or a word of JSON."""


class Value(NamedTuple):
    """A value of a JSON text, with its position."""

    path: Path
    start: int
    """The index of its key's first character, or of its own if it has no key."""
    text: str
    """The value as written; of an object or list only the opening bracket."""
    repeated: bool
    """Whether its key occurs earlier in the same object."""


@dataclass(slots=True)
class _Container:
    """An object or list that is being read."""

    path: Path
    step: str | int | None
    """The key or index of the next value; None where a key comes next."""
    keys: set[str] = field(default_factory=set)


def position(text: str, index: int) -> Position:
    """Return the line and column of a character."""
    return text.count("\n", 0, index) + 1, index - text.rfind("\n", 0, index)


def values(text: str) -> Iterator[Value]:
    """Yield every value of a JSON text, each before those within it.

    The text is well-formed, except for repeated keys and NaN or Infinity.
    """
    opened: list[_Container] = []
    inner: _Container | None = None
    start, repeated = -1, False
    for match in TOKEN.finditer(text):
        token = match[0]
        if token in "}]":
            opened.pop()
            inner = opened[-1] if opened else None
            _advance(inner)
        elif inner and inner.step is None:
            inner.step = key = token[1:-1] if "\\" not in token else json.loads(token)
            start, repeated = match.start(), key in inner.keys
            inner.keys.add(key)
        else:
            step = inner.step if inner else None
            path = (*inner.path, step) if inner and step is not None else ()
            keyed = isinstance(step, str)
            yield Value(path, start if keyed else match.start(), token, keyed and repeated)
            if token in "{[":
                inner = _Container(path, None if token == "{" else 0)
                opened.append(inner)
            else:
                _advance(inner)


def nested_beyond(text: str, depth: int) -> int:
    """Return the index of the first bracket nested deeper than a depth; 0 if there is none."""
    around = 0
    for match in TOKEN.finditer(text):
        if match[0] in "{[":
            if around >= depth:
                return match.start()
            around += 1
        elif match[0] in "}]":
            around -= 1
    return 0


def long_number(text: str, digits: int) -> int:
    """Return the index of the first number with more digits than given; 0 if there is none."""
    long = (match for match in TOKEN.finditer(text) if len(match[0]) > digits)
    return next((match.start() for match in long if not match[0].startswith('"')), 0)


def _advance(inner: _Container | None) -> None:
    """Proceed to the next member of the innermost container."""
    if inner:
        inner.step = inner.step + 1 if isinstance(inner.step, int) else None


def _there(path: Path) -> Path:
    return path


class Origin:
    """A JSON text, and the positions of its values.

    All origins are equal, so that equal levels compare equal wherever they were read. `typed` maps
    a path in the level to that in the text, by default to itself.
    """

    def __init__(self, text: str, source: str, typed: Callable[[Path], Path] = _there) -> None:
        self.text = text
        self.source = source
        self.typed = typed

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return 0

    @cached_property
    def values(self) -> dict[Path, Value]:
        """Every value of the text, by its path."""
        return {value.path: value for value in values(self.text)}

    def has(self, path: Path) -> bool:
        """Whether the text has a value for a path of the level."""
        return self.typed(path) in self.values

    def nearest(self, path: Path) -> Value:
        """Return the value at a path or, if it is missing, what encloses it."""
        path = self.typed(path)
        while path not in self.values:
            path = path[:-1]
        return self.values[path]

    def location(self, path: Path) -> str:
        """Return the file, line, column and path of a part, for the beginning of a message."""
        line, column = position(self.text, self.nearest(path).start)
        return f"{self.source}:{line}:{column}: {'.'.join(brief(str(step)) for step in path)}"
