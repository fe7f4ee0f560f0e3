"""From where to where each value of a JSON text reaches."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from sandbox.model.locating import TOKEN, Path

Kind = Literal["object", "list", "plain"]

_KINDS: Mapping[str, Kind] = {"{": "object", "[": "list"}


@dataclass(slots=True)
class Span:
    """A value of a JSON text, and where it stands.

    Attributes
    ----------
    path
        Of the value.
    start, begin, end
        Where its key begins, or it itself if it has none; where it begins; where it is over.
    kind
        Whether it holds others.
    members
        What it holds, in the order of the text.
    """

    path: Path
    start: int
    begin: int
    end: int = -1
    kind: Kind = "plain"
    members: list["Span"] = field(default_factory=list)


def spans(text: str) -> dict[Path, Span]:
    """Return where every value stands, by its path; the whole is at the empty one.

    Parameters
    ----------
    text
        Well-formed JSON in which no key stands twice in one object.
    """
    found: dict[Path, Span] = {}
    opened: list[Span] = []
    key: tuple[str, int] | None = None
    for match in TOKEN.finditer(text):
        token, inside = match[0], opened[-1] if opened else None
        if token in "}]":
            opened.pop().end = match.end()
        elif inside and inside.kind == "object" and key is None:
            key = json.loads(token), match.start()
        else:
            span = _span(inside, key, match.start())
            span.kind, span.end = _KINDS.get(token, "plain"), match.end()
            found[span.path], key = span, None
            if span.kind != "plain":
                opened.append(span)
    return found


def _span(inside: Span | None, key: tuple[str, int] | None, begin: int) -> Span:
    """Return the span of a value that begins, as a member of what it is inside of."""
    if inside is None:
        return Span((), begin, begin)
    step, start = key or (len(inside.members), begin)
    span = Span((*inside.path, step), start, begin)
    inside.members.append(span)
    return span
