"""The span of each value in a JSON text, looked up on demand."""

import json
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Literal

from sandbox.model.json_positions import Path

_GAP = re.compile(r"[\s,:]*")
_DECODER = json.JSONDecoder()  # written in C: it skips values much faster than a tokenizer


class Span:
    """A value of a JSON text, and its position there."""

    def __init__(self, text: str, path: Path, start: int, begin: int) -> None:
        self.path = path
        """The path of the value."""
        self.start = start
        self.begin = begin
        self.end = _DECODER.raw_decode(text, begin)[1]
        """The indices of the start of its key (of the value itself if it has no key), of the start
        of the value, and of its end."""
        self._text = text

    @property
    def kind(self) -> Literal["object", "list", "plain"]:
        """Whether the value is an object, a list, or neither."""
        opened = self._text[self.begin]
        return "object" if opened == "{" else "list" if opened == "[" else "plain"

    @cached_property
    def members(self) -> list["Span"]:
        """The values that it holds, in the order of the text."""
        return list(self._members()) if self.kind != "plain" else []

    @cached_property
    def by_step(self) -> Mapping[str | int, "Span"]:
        """The values that it holds, by key or index."""
        return {member.path[-1]: member for member in self.members}

    def _members(self) -> Iterator["Span"]:
        at, count, keyed = self._after(self.begin + 1), 0, self.kind == "object"
        while at < self.end - 1:
            start, step = at, count
            if keyed:
                step, at = _DECODER.raw_decode(self._text, at)
                at = self._after(at)
            member = Span(self._text, (*self.path, step), start, at)
            yield member
            at, count = self._after(member.end), count + 1

    def _after(self, index: int) -> int:
        """Return the index where the next value begins, or where this one is closed."""
        found = _GAP.match(self._text, index)
        return found.end() if found else index


class Spans(Mapping[Path, Span]):
    """The span of every value of a text, by its path; the empty path is the whole.

    The text is well-formed JSON without duplicate keys in an object.
    """

    def __init__(self, text: str) -> None:
        begin = len(text) - len(text.lstrip())
        self._whole = Span(text, (), begin, begin)

    def __getitem__(self, path: Path) -> Span:
        span = self._whole
        for step in path:
            span = span.by_step[step]
        return span

    def __iter__(self) -> Iterator[Path]:
        pending = [self._whole]
        while pending:
            span = pending.pop()
            yield span.path
            pending += reversed(span.members)

    def __len__(self) -> int:
        return sum(1 for _ in self)
