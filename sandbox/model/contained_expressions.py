"""Iteration over anything made of frozen parts and expressions."""

from collections.abc import Iterator, Mapping, Sequence

from sandbox.model.base import Model
from sandbox.model.expressions import Expression
from sandbox.model.json_positions import Path

_PLAIN = frozenset({type(None), bool, int, float, str})
"""The types of most parts, which contain no expression."""


def expressions(part: object, path: Path = ()) -> Iterator[tuple[Path, Expression]]:
    """Yield every expression in a part of a level, with its path."""
    pending = [(path, part)]
    while pending:
        path, part = pending.pop()
        if isinstance(part, Expression):
            yield path, part
        else:
            pending += [
                ((*path, name), child)
                for name, child in reversed(_children(part))
                if type(child) not in _PLAIN
            ]


def _children(part: object) -> Sequence[tuple[str | int, object]]:
    if isinstance(part, Model):
        return list(vars(part).items())
    if isinstance(part, tuple):
        return list(enumerate(part))
    return list(part.items()) if isinstance(part, Mapping) else ()
